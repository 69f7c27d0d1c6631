#include "pipeline/scene_setup.h"

#include <fmt/format.h>

#include <utility>

#include "core/errors.h"
#include "scene/scene_reader.h"
#include "trace/camera_rays.h"
#include "trace/overlap.h"

namespace knotlight {

namespace {

// A perspective eye is a point; an orthographic one a rectangle, looked at in 17 x 17 places.
bool eye_inside(const Camera& camera, const RayCaster& caster, std::uint32_t object) {
  const CameraRays rays(camera);
  constexpr int steps = 16;
  for (int y = 0; y <= steps; ++y)
    for (int x = 0; x <= steps; ++x) {
      const Ray ray = rays.ray(camera.width_px * x / static_cast<double>(steps),
                               camera.height_px * y / static_cast<double>(steps));
      if (caster.inside(ray.origin, object)) return true;
      if (camera.type == Camera::Type::perspective) return false;
    }
  return false;
}

// Photons, solution and picture then all see the reduced medium.
void make_similar(TranslucentMaterial& material) {
  for (int c = 0; c < 3; ++c) {
    const Medium similar = material.medium(c).similar();
    material.sigma_s[c] = similar.sigma_s;
    material.g[c] = similar.g;
  }
}

}  // namespace

PreparedScene prepare_scene(Scene scene) {
  PreparedScene prepared;
  prepared.scene = std::move(scene);
  if (prepared.scene.solver.similarity)
    for (Object& object : prepared.scene.objects)
      if (auto* material = std::get_if<TranslucentMaterial>(&object.material))
        make_similar(*material);
  const std::vector<Object>& objects = prepared.scene.objects;
  std::vector<const Shape*> shapes;
  for (const Object& object : objects) shapes.push_back(&object.shape);
  prepared.caster = std::make_unique<RayCaster>(shapes);
  for (std::uint32_t i = 0; i < objects.size(); ++i)
    if (objects[i].translucent() != nullptr) prepared.translucent.push_back(i);
  refuse_overlaps(prepared.scene, *prepared.caster);
  return prepared;
}

PreparedScene prepare_scene(const std::string& path, RunContext& run) {
  Scene scene;
  {
    const Stage stage(run.stages, "scene", 0);
    scene = read_scene(path, run.options.overrides);
  }
  const Stage stage(run.stages, "geometry", 0);
  if (!run.options.quiet)
    for (const std::string& warning : scene.warnings) fmt::print(stderr, "warning: {}\n", warning);

  PreparedScene prepared;
  try {
    prepared = prepare_scene(std::move(scene));
  } catch (const InputError& error) {
    throw InputError(path + ": objects: " + error.what());
  }
  for (const std::uint32_t i : prepared.translucent)
    if (eye_inside(prepared.scene.camera, *prepared.caster, i))
      throw InputError(
          fmt::format("{}: camera.from: lies inside object '{}', expected a place outside", path,
                      prepared.scene.objects[i].name));
  return prepared;
}

}  // namespace knotlight
