#include "scene/scene_reader.h"

#include <algorithm>

#include "core/errors.h"
#include "scene/scene_parts.h"
#include "scene/yaml_override.h"

namespace knotlight {
namespace {

bool shines(const Light& light) {
  const Spectrum& power = std::visit(
      [](const auto& l) -> const Spectrum& {
        using L = std::decay_t<decltype(l)>;
        if constexpr (std::is_same_v<L, PointLight>) {
          return l.intensity;
        } else if constexpr (std::is_same_v<L, DirectionalLight>) {
          return l.irradiance;
        } else {
          return l.radiance;
        }
      },
      light);
  return (power > 0.0).any();
}

bool shines(const Object& object) {
  const TranslucentMaterial* material = object.translucent();
  return material != nullptr && (material->emission > 0.0).any();
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  YamlNode root = read_yaml(path);
  if (root.kind == YamlNode::Kind::null) {
    fail(root, "the file is empty, expected a scene with camera, lights, materials and objects");
  }
  for (const std::string& override_text : overrides) apply_override(root, override_text);
  assign_paths(root);
  check_keys(root, {"units", "camera", "lights", "materials", "objects", "solver"});

  SceneContext context;
  context.folder = std::filesystem::path(path).parent_path();
  Scene scene;
  const YamlNode* units = root.find("units");
  scene.units = units != nullptr ? read_text(*units, "the name of a unit of length") : "unit";
  scene.camera = read_camera(require(root, "camera", "a map with at least from and to"));
  const YamlNode* lights = root.find("lights");
  if (lights != nullptr) scene.lights = read_lights(*lights, context);
  const auto materials =
      read_materials(require(root, "materials", "a map of materials by name"), context);
  scene.objects = read_objects(require(root, "objects", "a list of objects"), materials, context);
  if (const YamlNode* solver = root.find("solver")) scene.solver = read_solver(*solver);

  const bool is_dark = std::none_of(scene.lights.begin(), scene.lights.end(),
                                    [](const Light& light) { return shines(light); }) &&
                       std::none_of(scene.objects.begin(), scene.objects.end(),
                                    [](const Object& object) { return shines(object); });
  if (is_dark) {
    const std::string what = "nothing shines, expected a light or an emission above 0";
    if (lights != nullptr) fail(*lights, what);
    throw InputError(root.origin + ": lights: " + what);
  }
  scene.channels = context.coloured ? 3 : 1;
  scene.warnings = std::move(context.warnings);
  return scene;
}

}  // namespace knotlight
