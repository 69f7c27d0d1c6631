#include "scene/scene_reader.h"

#include "core/errors.h"
#include "scene/scene_parts.h"
#include "scene/shines.h"
#include "scene/yaml_override.h"

namespace knotlight {

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
  scene.solver.photons_at_most = true;  // as without the key `photons`
  if (const YamlNode* solver = root.find("solver")) scene.solver = read_solver(*solver);

  if (!anything_shines(scene)) {
    const std::string what = "nothing shines, expected a light or an emission above 0";
    if (lights != nullptr) fail(*lights, what);
    throw InputError(root.origin + ": lights: " + what);
  }
  scene.channels = context.coloured ? 3 : 1;
  scene.warnings = std::move(context.warnings);
  return scene;
}

}  // namespace knotlight
