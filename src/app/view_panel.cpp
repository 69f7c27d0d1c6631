#include "app/view_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>

#include "pipeline/plan.h"
#include "view/layers.h"

namespace knotlight {
namespace {

const ImVec4 red(1.0F, 0.42F, 0.36F, 1.0F);
const ImVec4 amber(1.0F, 0.76F, 0.38F, 1.0F);
const ImVec4 green(0.55F, 0.82F, 0.52F, 1.0F);
const ImVec4 grey(0.62F, 0.63F, 0.66F, 1.0F);

constexpr float relative_speed = 0.01F;  // of a value per pixel dragged
constexpr double largest_g = 0.99;       // beyond, phase functions are beams
constexpr double largest_ior = 3.0;      // no transparent matter is denser
constexpr float most_stops = 8.0F;

void text(const ImVec4& colour, const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

bool section(const char* name) {
  ImGui::Dummy(ImVec2(0.0F, 2.0F));
  return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen);
}

// Widgets leave this much room for their label at the right.
void label_column() {
  ImGui::PushItemWidth(-92.0F);
}

bool drag_number(const char* label, double& value, double speed, double least, double most) {
  return ImGui::DragScalar(label, ImGuiDataType_Double, &value, static_cast<float>(speed), &least,
                           &most, "%.4g", ImGuiSliderFlags_AlwaysClamp);
}

bool drag_vector(const char* label, Vec3& value, double speed) {
  return ImGui::DragScalarN(label, ImGuiDataType_Double, value.data(), 3, static_cast<float>(speed),
                            nullptr, nullptr, "%.3f");
}

// One value for a scene of one channel, else three. typical: what counts as a large change of it.
bool drag_spectrum(const char* label, Spectrum& value, int channels, double typical, double least,
                   double most) {
  const auto speed =
      relative_speed * static_cast<float>(std::max(value.abs().maxCoeff(), 0.1 * typical));
  const bool changed =
      ImGui::DragScalarN(label, ImGuiDataType_Double, value.data(), channels, speed, &least, &most,
                         "%.3g", ImGuiSliderFlags_AlwaysClamp);
  if (channels == 1) value = Spectrum::Constant(value[0]);
  return changed;
}

// "chosen (what it came to)" and the words; whether another was picked. An index of 0 stands for
// chosen.
bool choose(const char* label, int& index, const std::string& first,
            const std::vector<std::string>& names) {
  std::vector<const char*> items = {first.c_str()};
  for (const std::string& name : names) items.push_back(name.c_str());
  return ImGui::Combo(label, &index, items.data(), static_cast<int>(items.size()));
}

template <class T, std::size_t N>
int place_of(const std::optional<T>& value, const std::array<T, N>& values) {
  if (!value) return 0;
  return 1 + static_cast<int>(std::find(values.begin(), values.end(), *value) - values.begin());
}

// ---------------------------------------------------------------- what is known

std::string activity_in_words(const SolveThread::Status& status, const SolvedView* view,
                              ImVec4& colour) {
  colour = amber;
  switch (status.activity) {
    case SolveThread::Activity::preview:
      return "solving a preview";
    case SolveThread::Activity::waiting:
      return "preview; full quality follows";
    case SolveThread::Activity::full:
      return fmt::format("preview; solving in full quality, {:.0f} s", status.seconds);
    case SolveThread::Activity::idle:
      break;
  }
  if (!status.error.empty() || view == nullptr) {
    colour = red;
    return "not solved";
  }
  colour = view->report().failures.empty() ? green : red;
  return fmt::format("solved in full quality, {:.1f} s", view->seconds);
}

void draw_state(const ViewSession& session, const PanelState& state) {
  const SolveThread::Status status = session.status();
  ImVec4 colour;
  const std::string words = activity_in_words(status, session.view(), colour);
  const float radius = 0.3F * ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      ImVec2(corner.x + radius, corner.y + 0.55F * ImGui::GetTextLineHeight()), radius,
      ImGui::GetColorU32(colour));
  ImGui::SetCursorScreenPos(ImVec2(corner.x + 3.6F * radius, corner.y));
  ImGui::TextUnformatted(words.c_str());

  if (const auto frame = session.frame()) {
    const Camera& camera = frame->wish.camera;
    text(grey, frame->stride > 1
                   ? fmt::format("{} x {} in steps of {}, {:.0f} frames/s", camera.width_px,
                                 camera.height_px, frame->stride, state.frames_per_second)
                   : fmt::format("{} x {}, {} sample{} per pixel", camera.width_px,
                                 camera.height_px, frame->passes, frame->passes == 1 ? "" : "s"));
  }
}

// What a picture is not to be trusted for, in the words in which `render` says it.
std::vector<std::string> warnings_of(const ViewSession& session) {
  std::vector<std::string> warnings;
  if (const std::string error = session.status().error; !error.empty()) warnings.push_back(error);
  if (const std::string object = session.eye_inside(); !object.empty())
    warnings.push_back(
        fmt::format("The eye is inside '{}': what it sees there is not to be trusted", object));
  if (session.view() == nullptr) return warnings;
  const SolvedView& view = *session.view();
  if (!view.report().failures.empty())
    warnings.emplace_back(view.quality == Quality::preview ? "Not to be trusted (preview):"
                                                           : "Not to be trusted:");
  for (const std::string& failure : view.report().failures) warnings.push_back("- " + failure);
  return warnings;
}

void draw_solution(const ViewSession& session) {
  if (session.view() == nullptr || !section("Solution")) return;
  const SolvedView& view = *session.view();
  for (const ObjectReport& object : view.report().objects) {
    double error = 0.0;
    std::size_t photons = 0;
    for (const ChannelReport& channel : object.channels) {
      error = std::max(error, channel.error_estimate);
      photons += channel.photons;
    }
    text(grey, fmt::format("{}: {}, error estimate {:.2g}, {} photons{}", object.name,
                           object.channels[0].method, error, photons,
                           view.quality == Quality::preview ? " (preview)" : ""));
  }
}

// ---------------------------------------------------------------- what can be changed

void draw_picture_section(ViewSession& session, PanelState& state) {
  if (!section("Picture")) return;
  label_column();
  std::vector<std::string> names;
  for (const ViewLayer& layer : view_layers()) names.emplace_back(layer.name);
  if (choose("show", state.layer, "picture", names))
    session.set_layer(state.layer == 0 ? nullptr
                                       : &view_layers()[static_cast<std::size_t>(state.layer - 1)]);
  const bool amounts =
      state.layer > 0 && view_layers()[static_cast<std::size_t>(state.layer - 1)].per_channel;
  if (amounts && session.scene().channels == 3) {
    ImGui::RadioButton("red", &session.layer_channel, 0);
    ImGui::SameLine();
    ImGui::RadioButton("green", &session.layer_channel, 1);
    ImGui::SameLine();
    ImGui::RadioButton("blue", &session.layer_channel, 2);
  }
  if (state.layer == 0) {
    auto stops = static_cast<float>(session.exposure_stops);
    if (ImGui::SliderFloat("exposure", &stops, -most_stops, most_stops, "%+.1f stops"))
      session.exposure_stops = stops;
    ImGui::Checkbox("automatic", &session.exposure_automatic);
    ImGui::SameLine();
  }
  if (ImGui::Button("Reset camera")) session.reset_camera();
  ImGui::PopItemWidth();
}

// Whether anything was changed.
bool edit_light(Light& light, int channels, double scene_size) {
  constexpr double most = 1e15;  // as in the scene format
  const double speed = relative_speed * scene_size;
  bool changed = false;
  if (auto* point = std::get_if<PointLight>(&light)) {
    changed |= drag_vector("position", point->position, speed);
    changed |= drag_spectrum("intensity", point->intensity, channels, 1.0, 0.0, most);
  } else if (auto* beam = std::get_if<DirectionalLight>(&light)) {
    Vec3 direction = beam->direction;
    if (drag_vector("direction", direction, relative_speed) && direction.norm() > 1e-6) {
      beam->direction = direction.normalized();
      changed = true;
    }
    changed |= drag_spectrum("irradiance", beam->irradiance, channels, 1.0, 0.0, most);
  } else if (auto* area = std::get_if<AreaLight>(&light)) {
    changed |= drag_vector("center", area->center, speed);
    changed |= drag_spectrum("radiance", area->radiance, channels, 1.0, 0.0, most);
  } else if (auto* sky = std::get_if<EnvironmentLight>(&light)) {
    changed |= drag_spectrum("radiance", sky->radiance, channels, 1.0, 0.0, most);
  }
  return changed;
}

std::string kind_of(const Light& light) {
  constexpr std::array<const char*, 4> kinds = {"point", "directional", "area", "environment"};
  return kinds[light.index()];
}

void draw_lights(ViewSession& session) {
  if (session.scene().lights.empty() || !section("Lights")) return;
  label_column();
  const double size = (session.camera().to - session.camera().from).norm();
  for (std::size_t i = 0; i < session.scene().lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    text(grey, fmt::format("{}  {}", i + 1, kind_of(session.scene().lights[i])));
    Light light = session.scene().lights[i];
    if (edit_light(light, session.scene().channels, size))
      session.edit(Change::lights, [&](Scene& scene) { scene.lights[i] = light; });
    ImGui::PopID();
  }
  ImGui::PopItemWidth();
}

bool edit_material(Material& material, int channels) {
  constexpr double most = 1e12;  // as in the scene format
  bool changed = false;
  if (auto* wax = std::get_if<TranslucentMaterial>(&material)) {
    const double sigma_t = (wax->sigma_a + wax->sigma_s).maxCoeff();
    // What neither absorbs nor scatters is not matter.
    const double least = 1e-6 * sigma_t;
    changed |= drag_spectrum("sigma_a", wax->sigma_a, channels, 0.1 * sigma_t, 0.0, most);
    changed |= drag_spectrum("sigma_s", wax->sigma_s, channels, sigma_t, least, most);
    changed |= drag_spectrum("g", wax->g, channels, 1.0, -largest_g, largest_g);
    changed |= drag_number("ior", wax->ior, 0.2 * relative_speed, 1.0, largest_ior);
    if ((wax->emission > 0.0).any())
      changed |= drag_spectrum("emission", wax->emission, channels, 1.0, 0.0, most);
  } else if (auto* diffuse = std::get_if<DiffuseMaterial>(&material)) {
    changed |= drag_spectrum("reflectance", diffuse->reflectance, channels, 1.0, 0.0, 1.0);
  }
  return changed;
}

void draw_materials(ViewSession& session) {
  if (!section("Materials")) return;
  label_column();
  for (const NamedMaterial& named : session.materials()) {
    ImGui::PushID(named.name.c_str());
    Material material = session.scene().objects[named.objects.front()].material;
    text(grey, fmt::format(
                   "{}  {}", named.name,
                   std::holds_alternative<DiffuseMaterial>(material) ? "diffuse" : "translucent"));
    if (edit_material(material, session.scene().channels)) session.edit_material(named, material);
    ImGui::PopID();
  }
  ImGui::PopItemWidth();
}

bool edit_choices(SolverSettings& solver, const SolvedView* view, bool& exitance_changed) {
  static constexpr std::array sources = {SourceModel::photon_map, SourceModel::irradiance_sampling,
                                         SourceModel::irradiance_thesis,
                                         SourceModel::boundary_flux};
  static constexpr std::array methods = {Method::bkm_thesis, Method::bkm, Method::mfs, Method::lbkm,
                                         Method::grid};
  static constexpr std::array exitances = {Exitance::gather, Exitance::p1, Exitance::lambert,
                                           Exitance::mean_intensity};
  bool changed = false;
  int index = place_of(solver.source, sources);
  if (choose("source", index,
             view != nullptr && !solver.source
                 ? fmt::format("chosen: {}", name_of(view->solved->plan.source))
                 : "chosen",
             {"photon_map", "irradiance_sampling", "irradiance_thesis", "boundary_flux"})) {
    if (index == 0)
      solver.source.reset();
    else
      solver.source = sources[static_cast<std::size_t>(index - 1)];
    changed = true;
  }
  index = solver.method == Method::automatic
              ? 0
              : place_of(std::optional<Method>(solver.method), methods);
  if (choose("method", index, "auto", {"bkm_thesis", "bkm", "mfs", "lbkm", "grid"})) {
    solver.method = index == 0 ? Method::automatic : methods[static_cast<std::size_t>(index - 1)];
    changed = true;
  }
  index = place_of(solver.exitance, exitances);
  if (choose("exitance", index, "chosen", {"gather", "p1", "lambert", "mean_intensity"})) {
    if (index == 0)
      solver.exitance.reset();
    else
      solver.exitance = exitances[static_cast<std::size_t>(index - 1)];
    exitance_changed = true;
  }
  int marshak = solver.boundary == Boundary::marshak ? 1 : 0;
  if (ImGui::Combo("boundary", &marshak, "milne\0marshak\0")) {
    solver.boundary = marshak == 1 ? Boundary::marshak : Boundary::milne;
    changed = true;
  }
  return changed;
}

bool edit_count(const char* label, std::size_t& count, std::size_t least, std::size_t most) {
  const auto speed = relative_speed * static_cast<float>(count);
  return ImGui::DragScalar(label, ImGuiDataType_U64, &count, std::max(1.0F, speed), &least, &most,
                           "%llu", ImGuiSliderFlags_AlwaysClamp);
}

void draw_solver(ViewSession& session) {
  constexpr double least_tolerance = 1e-4, most_tolerance = 0.5;
  constexpr std::size_t least_photons = 10'000, most_preview = 5'000'000,
                        most_photons = 500'000'000;
  if (!section("Solver")) return;
  label_column();
  SolverSettings solver = session.scene().solver;
  bool exitance_changed = false;
  bool changed = edit_choices(solver, session.view(), exitance_changed);
  changed |= drag_number("tolerance", solver.tolerance, relative_speed * solver.tolerance,
                         least_tolerance, most_tolerance);
  if (edit_count("photons", solver.photons, least_photons, most_photons)) {
    solver.photons_at_most = false;
    changed = true;
  }
  if (changed || exitance_changed)
    session.edit(changed ? Change::materials : Change::exitance,
                 [&](Scene& scene) { scene.solver = solver; });
  PreviewSettings preview = session.preview();
  if (edit_count("in preview", preview.photons, least_photons, most_preview))
    session.set_preview(preview);
  ImGui::PopItemWidth();
}

void draw_saving(ViewSession& session, PanelState& state) {
  if (!section("Save")) return;
  ImGui::PushItemWidth(-92.0F);
  ImGui::InputText("##picture", &state.picture_name);
  ImGui::SameLine();
  if (ImGui::Button("Picture", ImVec2(-1.0F, 0.0F))) save_picture(session, state);
  ImGui::InputText("##scene", &state.scene_name);
  ImGui::SameLine();
  if (ImGui::Button("Scene", ImVec2(-1.0F, 0.0F))) save_scene(session, state);
  ImGui::PopItemWidth();
  if (!state.message.empty()) text(state.message_is_error ? red : green, state.message);
}

void save(PanelState& state, const std::function<std::string()>& write) {
  try {
    state.message = "Saved " + write();
    state.message_is_error = false;
  } catch (const std::exception& error) {
    state.message = error.what();
    state.message_is_error = true;
  }
}

}  // namespace

void save_picture(const ViewSession& session, PanelState& state) {
  const auto frame = session.frame();
  state.picture_wanted = !frame || frame->stride > 1;
  if (state.picture_wanted) {
    state.message = "Saving as soon as the picture is sharp";
    state.message_is_error = false;
    return;
  }
  save(state, [&] { return session.save_picture(state.picture_name); });
}

void save_scene(const ViewSession& session, PanelState& state) {
  save(state, [&] {
    session.save_scene(state.scene_name);
    return state.scene_name;
  });
}

void draw_panel(ViewSession& session, PanelState& state, float x, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(x, 0.0F));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  if (state.picture_wanted) save_picture(session, state);
  draw_state(session, state);
  draw_picture_section(session, state);
  draw_saving(session, state);
  draw_lights(session);
  draw_materials(session);
  draw_solver(session);
  draw_solution(session);
  ImGui::Dummy(ImVec2(0.0F, 2.0F));
  text(grey, "F1: keys and mouse");
  ImGui::End();
}

void draw_warnings(const ViewSession& session, float picture_width) {
  const std::vector<std::string> warnings = warnings_of(session);
  if (warnings.empty()) return;
  constexpr float margin = 12.0F;
  ImGui::SetNextWindowPos(ImVec2(margin, margin));
  ImGui::SetNextWindowSize(ImVec2(picture_width - 2.0F * margin, 0.0F));
  ImGui::Begin("warnings", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
  for (const std::string& warning : warnings) text(red, warning);
  ImGui::End();
}

void draw_help(PanelState& state, float picture_width, float height) {
  if (!state.help) return;
  constexpr std::array<std::array<const char*, 2>, 9> rows = {{
      {"left drag", "turn about the camera's target"},
      {"left drag on a light", "move it in the plane of the picture"},
      {"wheel", "nearer, further"},
      {"right or middle drag", "shift"},
      {"space", "camera as in the scene"},
      {"S", "save the picture (.exr and .png)"},
      {"drag on a number", "change it; double click to type"},
      {"F1", "this list"},
      {"Esc, Q", "quit"},
  }};
  ImGui::SetNextWindowPos(ImVec2(0.5F * picture_width, 0.5F * height), ImGuiCond_Always,
                          ImVec2(0.5F, 0.5F));
  ImGui::Begin("Keys and mouse", &state.help,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::BeginTable("keys", 2)) {
    for (const auto& row : rows) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(amber, "%s", row[0]);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row[1]);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace knotlight
