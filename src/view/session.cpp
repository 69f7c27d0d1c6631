#include "view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/errors.h"
#include "core/file_io.h"
#include "report/png.h"
#include "scene/scene_reader.h"
#include "scene/yaml_override.h"
#include "view/display.h"
#include "view/scene_writer.h"

namespace knotlight {
namespace {

// As many times the scene's samples, and not fewer than 256: by then noise is a quarter and less of
// what `render` would leave, and the machine may rest. A preview gets the scene's samples, and then
// leaves the machine to the full solve.
constexpr int passes_per_sample = 16;
constexpr int fewest_passes = 256;
// When the full quality replaces a preview under an unmoved camera, the preview stays on the screen
// until the new picture has this many samples, so that it does not become noisier.
constexpr int passes_before_replacing = 4;
// Of the way to the exposure of a new frame: at 20 frames a second an eye's second.
constexpr double exposure_step = 0.15;

PreparedScene checked_scene(const std::string& path, const RunOptions& options) {
  RunContext run(options, false);
  return prepare_scene(path, run);
}

std::vector<NamedMaterial> used_materials(const YamlNode& document) {
  std::vector<NamedMaterial> materials;
  const std::vector<YamlNode>& objects = document.find("objects")->items;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const std::string& name = objects[i].find("material")->text;
    auto found = std::find_if(materials.begin(), materials.end(),
                              [&](const NamedMaterial& m) { return m.name == name; });
    if (found == materials.end()) found = materials.insert(found, NamedMaterial{name, {}});
    found->objects.push_back(i);
  }
  return materials;
}

std::filesystem::path folder_of(const std::string& file) {
  return std::filesystem::absolute(file).parent_path();
}

void check_folder(const std::string& file) {
  if (!std::filesystem::is_directory(folder_of(file)))
    throw InputError(
        fmt::format("{}: its folder does not exist, expected a place to write to", file));
}

}  // namespace

ViewSession::ViewSession(const std::string& path, const RunOptions& options,
                         const std::function<void()>& on_change)
    : path_(path),
      options_(options),
      solve_thread_(options, on_change),
      picture_thread_(options.seed, options.threads, on_change) {
  PreparedScene checked = checked_scene(path, options);
  caster_ = std::move(checked.caster);
  // A scene that asks for similarity was prepared with other coefficients than it has.
  scene_ = checked.scene.solver.similarity ? read_scene(path, options.overrides)
                                           : std::move(checked.scene);
  document_ = read_yaml(path);
  for (const std::string& text : options.overrides) apply_override(document_, text);
  original_ = scene_;
  materials_ = used_materials(document_);
  set_room(scene_.camera.width_px, scene_.camera.height_px);
  solve_thread_.request(scene_, preview_, Change::materials);
}

void ViewSession::edit(Change change, const std::function<void(Scene&)>& with) {
  with(scene_);
  solve_thread_.request(scene_, preview_, change);
}

void ViewSession::set_preview(const PreviewSettings& preview) {
  preview_ = preview;
  solve_thread_.request(scene_, preview_, Change::materials);
}

void ViewSession::edit_material(const NamedMaterial& material, const Material& value) {
  edit(Change::materials, [&](Scene& scene) {
    for (const std::uint32_t object : material.objects) scene.objects[object].material = value;
  });
}

void ViewSession::set_camera(const Camera& camera) {
  scene_.camera = camera;
  ask_for_picture(0);
}

void ViewSession::set_room(int width, int height) {
  width = std::max(width, 1);
  height = std::max(height, 1);
  if (width == room_width_ && height == room_height_) return;
  room_width_ = width;
  room_height_ = height;
  ask_for_picture(0);
}

void ViewSession::set_layer(const ViewLayer* layer) {
  if (layer == layer_) return;
  layer_ = layer;
  ask_for_picture(0);
}

void ViewSession::update() {
  const std::shared_ptr<const SolvedView> newest = solve_thread_.latest();
  if (newest != view_) {
    const bool replaces = view_ && newest->quality == Quality::full;
    view_ = newest;
    ask_for_picture(replaces ? passes_before_replacing : 0);
  }
  const std::uint64_t made = frames();
  const std::shared_ptr<const PictureFrame> newest_frame = frame();
  if (exposure_automatic && newest_frame && newest_frame->wish.layer == nullptr &&
      made != metered_frames_) {
    metered_frames_ = made;
    const double wanted = automatic_exposure(newest_frame->image);
    automatic_exposure_ =
        automatic_exposure_ == 0.0
            ? wanted
            : automatic_exposure_ * std::pow(wanted / automatic_exposure_, exposure_step);
  }
}

void ViewSession::ask_for_picture(int silent_passes) {
  if (!view_) return;
  const bool preview = view_->quality == Quality::preview;
  picture_thread_.show({view_, picture_camera(), layer_,
                        preview ? std::min(scene_.camera.samples, fewest_passes) : most_passes(),
                        silent_passes});
}

int ViewSession::most_passes() const {
  return std::max(fewest_passes, passes_per_sample * scene_.camera.samples);
}

double ViewSession::exposure() const {
  const double base = automatic_exposure_ == 0.0 ? 1.0 : automatic_exposure_;
  return base * std::exp2(exposure_stops);
}

std::string ViewSession::eye_inside() const {
  if (scene_.camera.type == Camera::Type::orthographic) return "";
  for (std::uint32_t i = 0; i < scene_.objects.size(); ++i)
    if (scene_.objects[i].translucent() != nullptr && caster_->inside(scene_.camera.from, i))
      return scene_.objects[i].name;
  return "";
}

std::string ViewSession::save_picture(const std::string& stem) const {
  const std::shared_ptr<const PictureFrame> shown = frame();
  if (!shown || shown->stride > 1)
    throw InputError("the picture is not ready yet, expected a moment's rest");
  check_folder(stem);
  const Report& report = shown->wish.view->report();
  Metadata metadata = {
      {"Software", "knotlight " KNOTLIGHT_VERSION},
      {"knotlight:scene", path_},
      {"knotlight:samples", fmt::format("{}", shown->passes)},
      {"knotlight:quality", shown->wish.view->quality == Quality::full ? "full" : "preview"},
      {"knotlight:trusted", report.failures.empty() ? "yes" : "no"}};
  if (!report.failures.empty())
    metadata.emplace_back("knotlight:failures",
                          fmt::format("{}", fmt::join(report.failures, "; ")));
  const ViewLayer* layer = shown->wish.layer;
  Image linear = shown->image;
  Image display = layer == nullptr ? display_image(linear, exposure())
                                   : layer_colours(linear, *layer, layer_channel,
                                                   layer_scale(linear, layer_channel));
  // Files have no place for "nothing there": 0, as in the layers of `render`.
  if (layer != nullptr)
    for (Spectrum& pixel : linear.pixels)
      if (pixel.isNaN().any()) pixel.setZero();
  write_image(stem + ".exr", linear, metadata);
  const std::vector<unsigned char> png = png_bytes(display);
  write_text_file(stem + ".png", std::string(png.begin(), png.end()));
  return fmt::format("{0}.exr and {0}.png", stem);
}

void ViewSession::save_scene(const std::string& file) const {
  if (std::filesystem::path(file).extension() != ".yaml")
    throw InputError(fmt::format("{}: cannot write that format, expected .yaml", file));
  check_folder(file);
  YamlNode document = document_;
  put_changes(document, original_, scene_);
  move_paths(document, folder_of(path_), folder_of(file));
  write_text_file(file, leading_comment(path_) + yaml_text(document));
}

}  // namespace knotlight
