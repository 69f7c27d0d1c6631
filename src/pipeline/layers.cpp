#include "pipeline/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/errors.h"
#include "core/per_channel.h"
#include "pipeline/glow.h"
#include "pipeline/unscattered_light.h"
#include "scene/nearest_name.h"
#include "trace/camera_rays.h"
#include "trace/direct_light.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double infinite = std::numeric_limits<double>::infinity();
// What is not known is infinitely wrong; EXR readers draw not-a-number as they like.
double infinite_if_unknown(double error) {
  return std::isnan(error) ? infinite : error;
}

// What all pixels share.
struct View {
  const PreparedScene& prepared;
  const SolvedScene& solved;
  const GlowingSurfaces& surfaces;
  const Shading& shading;
  std::uint64_t seed;
  std::optional<PreparedScene> similar;  // the scene that was solved, if it is another
  std::vector<int> solved_index;         // per object: in SolvedScene::objects; -1 for diffuse ones
  std::vector<Spectrum> surface_rms;     // per object: of U_d over the nodes of its surface
};

View make_view(const PreparedScene& prepared, const SolvedScene& solved,
               const GlowingSurfaces& surfaces, const Shading& shading, std::uint64_t seed) {
  const std::size_t objects = prepared.scene.objects.size();
  View view{prepared,
            solved,
            surfaces,
            shading,
            seed,
            similar_scene(prepared),
            std::vector<int>(objects, -1),
            std::vector<Spectrum>(objects, Spectrum::Zero())};
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const std::uint32_t object = prepared.translucent[i];
    view.solved_index[object] = static_cast<int>(i);
    for (int c = 0; c < prepared.scene.channels; ++c)
      view.surface_rms[object][c] =
          root_mean_square(surfaces[object]->U_d[static_cast<std::size_t>(c)]);
  }
  return view;
}

// The surface in the middle of a pixel. What several layers share is computed once, from random
// numbers of its own, so that no layer depends on what others were asked for.
class VisiblePlace {
 public:
  VisiblePlace(const View& view, const Hit& hit, std::uint64_t pixel)
      : view_(view),
        scene_(view.prepared.scene),
        hit_(hit),
        material_(scene_.objects[hit.object].translucent()),
        pixel_(pixel) {}

  const Hit& hit() const { return hit_; }
  Spectrum U_ri() { return material_ == nullptr ? Spectrum(Spectrum::Zero()) : light().U_ri; }
  Spectrum U_d();
  Spectrum source();
  Spectrum robin_residual();
  Spectrum error_estimate() const;

 private:
  template <typename Value>
  Spectrum per_channel(const Value& value) const {
    return knotlight::per_channel(scene_.channels, value);
  }
  const std::vector<SolvedChannel>& solution() const {
    return view_.solved.objects[static_cast<std::size_t>(view_.solved_index[hit_.object])];
  }
  // Of each light that is looked for by chance: as many as the picture has.
  int samples() const { return scene_.camera.samples; }
  // Each use of random numbers has a stream of its own.
  enum class Use { light, transient, entering, uses };
  Rng rng(Use use) const {
    return {view_.seed, Stream::layers,
            pixel_ * static_cast<std::uint64_t>(Use::uses) + static_cast<std::uint64_t>(use)};
  }
  // In this scene or the one of similar media, by the same random numbers.
  UnscatteredLight unscattered(const Scene& scene) const;
  const UnscatteredLight& light();
  Spectrum entered() const;

  const View& view_;
  const Scene& scene_;
  const Hit& hit_;
  const TranslucentMaterial* material_;  // null on a diffuse object
  std::uint64_t pixel_;
  std::optional<UnscatteredLight> light_;
};

UnscatteredLight VisiblePlace::unscattered(const Scene& scene) const {
  Rng own = rng(Use::light);
  return unscattered_light(scene, *view_.prepared.caster, hit_, samples(), own);
}

const UnscatteredLight& VisiblePlace::light() {
  if (!light_) light_ = unscattered(scene_);
  return *light_;
}

// Irradiance that passes into the object, W/length^2.
Spectrum VisiblePlace::entered() const {
  Rng own = rng(Use::entering);
  return mean_irradiance(scene_, *view_.prepared.caster, hit_.position, hit_.normal, samples(), own,
                         material_->ior);
}

Spectrum VisiblePlace::U_d() {
  if (material_ == nullptr) return Spectrum::Zero();
  Rng own = rng(Use::transient);
  const Spectrum U = view_.shading.solution_at(hit_, samples(), own);
  if (view_.surfaces[hit_.object]->inside.counts_entering_light) return U - light().U_ri;
  // All light is the same in both media, what of it is not yet scattered is not.
  return view_.similar ? Spectrum(U + unscattered(view_.similar->scene).U_ri - light().U_ri) : U;
}

// -f of the P1 equation, W/(length^4 sr).
Spectrum VisiblePlace::source() {
  if (material_ == nullptr) return Spectrum::Zero();
  const Spectrum& U = light().U_ri;
  return per_channel([&](int c) {
    const Medium medium = material_->medium(c);
    const DiffusionCoefficients p1 = diffusion_coefficients(medium, scene_.solver.boundary);
    return -p1.source_per_U_ri * U[c] - p1.source_per_E * medium.emission;
  });
}

// |u + k du/dn - data| of the equation that was solved, over the rms of u on the object's surface.
Spectrum VisiblePlace::robin_residual() {
  if (material_ == nullptr) return Spectrum::Zero();
  const SourceModel model = view_.solved.plan.source;
  const Spectrum arriving =
      model == SourceModel::boundary_flux ? entered() : Spectrum(Spectrum::Zero());
  return per_channel([&](int c) {
    const SolvedChannel& channel = solution()[static_cast<std::size_t>(c)];
    const Medium& medium = channel.equation.medium;
    const DiffusionCoefficients& coefficients = channel.equation.coefficients;
    double data = 0.0;
    if (model == SourceModel::boundary_flux)
      data = coefficients.boundary_flux_data(arriving[c]);
    else if (model == SourceModel::photon_map && medium.g != 0.0)
      data = coefficients.robin_data(medium.g * medium.sigma_s * light().F_ri[c]);
    const GridField::Sample at = channel.on_grid->sample(hit_.position);
    return infinite_if_unknown(
        relative(std::abs(at.value + coefficients.k * at.gradient.dot(hit_.normal) - data),
                 view_.surface_rms[hit_.object][c]));
  });
}

Spectrum VisiblePlace::error_estimate() const {
  if (material_ == nullptr) return Spectrum::Zero();
  return per_channel([&](int c) {
    return infinite_if_unknown(solution()[static_cast<std::size_t>(c)].report.error_estimate);
  });
}

struct LayerKind {
  enum class Form { number, colour, vector };
  const char* name;
  Form form;
  const char* meaning;  // {0}: the unit of length
  double nowhere;       // where no object is met
  Spectrum (*value)(VisiblePlace& place) = nullptr;
  Image PictureParts::*part = nullptr;  // in place of value: comes with the picture itself
};

using Form = LayerKind::Form;

const std::vector<LayerKind> kinds = {
    {"fluence", Form::colour, "4 pi (U_d + U_ri), W/{0}^2", 0.0,
     [](VisiblePlace& p) -> Spectrum { return 4.0 * pi * (p.U_d() + p.U_ri()); }},
    {"U_d", Form::colour, "mean intensity of scattered light, W/({0}^2 sr)", 0.0,
     [](VisiblePlace& p) { return p.U_d(); }},
    {"U_ri", Form::colour, "mean intensity of light not yet scattered, W/({0}^2 sr)", 0.0,
     [](VisiblePlace& p) { return p.U_ri(); }},
    {"source", Form::colour, "-f of the diffusion equation P1, W/({0}^4 sr)", 0.0,
     [](VisiblePlace& p) { return p.source(); }},
    {"robin_residual", Form::colour,
     "|U_d + k dU_d/dn - data| over the rms of U_d on the object's surface", 0.0,
     [](VisiblePlace& p) { return p.robin_residual(); }},
    {"error_estimate", Form::colour,
     "rms error of U_d over its rms on the object's surface: one number per object", 0.0,
     [](VisiblePlace& p) { return p.error_estimate(); }},
    {"single", Form::colour,
     "light of the picture that the object seen has scattered once, W/({0}^2 sr)", 0.0, nullptr,
     &PictureParts::once},
    {"multiple", Form::colour,
     "light of the picture that the object seen has scattered more than once, or emitted, "
     "W/({0}^2 sr)",
     0.0, nullptr, &PictureParts::more},
    {"depth", Form::number, "distance from the eye, {0}", infinite,
     [](VisiblePlace& p) -> Spectrum { return Spectrum::Constant(p.hit().t); }},
    {"position", Form::vector, "place on the surface, {0}", 0.0,
     [](VisiblePlace& p) -> Spectrum { return p.hit().position; }},
    {"normal", Form::vector, "outward unit normal", 0.0,
     [](VisiblePlace& p) -> Spectrum { return p.hit().normal; }},
    {"object", Form::number, "number of the object in the scene, from 0", -1.0,
     [](VisiblePlace& p) -> Spectrum { return Spectrum::Constant(p.hit().object); }},
};

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const LayerKind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

// Why the scene's solution has no residual to show; empty if it has one everywhere.
std::string residual_unknown(const PreparedScene& prepared, const SolvedScene& solved) {
  for (std::size_t i = 0; i < solved.objects.size(); ++i)
    for (const SolvedChannel& channel : solved.objects[i])
      if (channel.report.method != name_of(Method::grid) || !channel.on_grid)
        return fmt::format("object '{}' was {} by {}, expected a solution by grid",
                           prepared.scene.objects[prepared.translucent[i]].name,
                           channel.solved ? "solved" : "not solved", channel.report.method);
  return "";
}

// Why the picture does not tell light scattered once from other light; empty if it does.
std::string parts_unknown(const PreparedScene& prepared, const SolvedScene& solved) {
  if (chosen_exitance(prepared.scene.solver) != Exitance::gather)
    return "expected solver.exitance gather";
  if (solved.plan.source == SourceModel::boundary_flux)
    return "boundary_flux solves for all light together, expected another solver.source";
  return "";
}

std::vector<std::string> components(const LayerKind& kind) {
  const std::string name = kind.name;
  switch (kind.form) {
    case Form::number:
      return {name};
    case Form::colour:
      return {name + ".R", name + ".G", name + ".B"};
    case Form::vector:
      return {name + ".X", name + ".Y", name + ".Z"};
  }
  return {};
}

}  // namespace

std::vector<std::string> chosen_layers(const std::string& list) {
  std::vector<std::string> known = all_names();
  std::vector<std::string> wanted;
  std::istringstream words(list + ",");  // a comma at the end has an empty name behind it
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "all") return known;
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw InputError(fmt::format("--layers: there is no layer '{}'{}, expected all or some of {}",
                                   word, did_you_mean(word, known), fmt::join(known, ",")));
    wanted.push_back(word);
  }
  std::vector<std::string> ordered;
  for (const std::string& name : known)
    if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) ordered.push_back(name);
  return ordered;
}

bool holds_layers(const std::string& path) {
  return std::filesystem::path(path).extension() == ".exr";
}

PictureLayers picture_layers(const std::vector<std::string>& names, const PreparedScene& prepared,
                             const SolvedScene& solved, const GlowingSurfaces& surfaces,
                             const Shading& shading, const PictureParts& parts, RunContext& run) {
  const Camera& camera = prepared.scene.camera;
  const auto width = static_cast<std::size_t>(camera.width_px);
  const auto height = static_cast<std::size_t>(camera.height_px);
  PictureLayers result;
  std::vector<const LayerKind*> wanted;
  for (const LayerKind& kind : kinds) {
    if (std::find(names.begin(), names.end(), kind.name) == names.end()) continue;
    std::string unknown;
    if (kind.part != nullptr) unknown = parts_unknown(prepared, solved);
    if (kind.name == std::string("robin_residual")) unknown = residual_unknown(prepared, solved);
    if (!unknown.empty()) {
      result.warnings.push_back(fmt::format("layer {} is left out: {}", kind.name, unknown));
      continue;
    }
    wanted.push_back(&kind);
    result.metadata.emplace_back(std::string("knotlight:layer:") + kind.name,
                                 fmt::format(fmt::runtime(kind.meaning), prepared.scene.units));
    for (const std::string& channel : components(kind))
      result.channels.push_back({channel, std::vector<float>(width * height)});
  }
  const View view = make_view(prepared, solved, surfaces, shading, run.options.seed);
  const CameraRays rays(camera);
  Stage stage(run.stages, "layers", height);
  run.workers.for_chunks(height, 1, [&](std::size_t y, std::size_t, std::size_t) {
    for (std::size_t x = 0; x < width; ++x) {
      const auto hit = prepared.caster->nearest(
          rays.ray(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5));
      const std::size_t pixel = y * width + x;
      std::optional<VisiblePlace> place;
      if (hit) place.emplace(view, *hit, pixel);
      std::size_t channel = 0;
      for (const LayerKind* kind : wanted) {
        Spectrum value = Spectrum::Constant(kind->nowhere);
        if (kind->part != nullptr)
          value = (parts.*kind->part).pixels[pixel];
        else if (place)
          value = kind->value(*place);
        const std::size_t count = components(*kind).size();
        for (std::size_t i = 0; i < count; ++i)
          result.channels[channel++].values[pixel] = static_cast<float>(value[static_cast<int>(i)]);
      }
    }
    stage.advance();
  });
  return result;
}

void write_picture_with_layers(const std::string& path, const Image& image,
                               const PictureLayers& layers, Metadata metadata) {
  std::vector<Layer> channels = {{"R", {}}, {"G", {}}, {"B", {}}};
  for (const Spectrum& pixel : image.pixels) {
    if (!pixel.isFinite().all())
      throw std::runtime_error(path + ": the picture has pixels that are not finite");
    for (std::size_t c = 0; c < 3; ++c)
      channels[c].values.push_back(static_cast<float>(pixel[static_cast<int>(c)]));
  }
  channels.insert(channels.end(), layers.channels.begin(), layers.channels.end());
  metadata.insert(metadata.end(), layers.metadata.begin(), layers.metadata.end());
  write_layers(path, image.width, image.height, channels, metadata);
}

}  // namespace knotlight
