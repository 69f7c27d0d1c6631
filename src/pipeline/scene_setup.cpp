#include "pipeline/scene_setup.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "scene/scene_reader.h"
#include "trace/overlap.h"

namespace knotlight {

PreparedScene prepare_scene(const std::string& path, RunContext& run) {
  PreparedScene prepared;
  {
    const Stage stage(run.stages, "scene", 0);
    prepared.scene = read_scene(path, run.options.overrides);
  }
  const Stage stage(run.stages, "geometry", 0);
  const Scene& scene = prepared.scene;
  if (!run.options.quiet)
    for (const std::string& warning : scene.warnings) fmt::print(stderr, "warning: {}\n", warning);

  std::vector<const Shape*> shapes;
  for (const Object& object : scene.objects) shapes.push_back(&object.shape);
  prepared.caster = std::make_unique<RayCaster>(shapes);
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].translucent() != nullptr) prepared.translucent.push_back(i);

  try {
    refuse_overlaps(scene, *prepared.caster);
  } catch (const InputError& error) {
    throw InputError(path + ": objects: " + error.what());
  }
  for (const std::uint32_t i : prepared.translucent)
    if (prepared.caster->inside(scene.camera.from, i))
      throw InputError(
          fmt::format("{}: camera.from: lies inside object '{}', expected a place outside", path,
                      scene.objects[i].name));
  return prepared;
}

}  // namespace knotlight
