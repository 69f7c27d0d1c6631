// Scenes for the tests of src/rivals.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/mesh.h"
#include "pipeline/scene_setup.h"

namespace knotlight::test {

inline TranslucentMaterial material(const Medium& m) {
  TranslucentMaterial result;
  result.sigma_a = Spectrum::Constant(m.sigma_a);
  result.sigma_s = Spectrum::Constant(m.sigma_s);
  result.g = Spectrum::Constant(m.g);
  result.ior = m.ior;
  result.emission = Spectrum::Constant(m.emission);
  return result;
}

inline PreparedScene one_object(Shape shape, const Medium& m, Light light) {
  Scene scene;
  scene.lights = {std::move(light)};
  scene.objects = {{"body", std::move(shape), material(m)}};
  return prepare_scene(std::move(scene));
}

// A box of 40 x 40 x 8 with its top at z = 0, which passes for a half-space near its centre if its
// mean free path is about 1; of triangles small enough to interpolate between their corners.
inline PreparedScene half_space(const Medium& m, Light light) {
  return one_object(refine(box_mesh(Vec3(-20, -20, -8), Vec3(20, 20, 0)), 2.0), m,
                    std::move(light));
}

inline Light beam(const Vec3& direction, double irradiance) {
  return DirectionalLight{direction.normalized(), Spectrum::Constant(irradiance)};
}

}  // namespace knotlight::test
