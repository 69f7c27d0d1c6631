// Small scenes and the trace of them, for the tests of photon/.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "photon/photon_tracer.h"

namespace knotlight::testing_scenes {

// Five standard errors, two-sided: a false alarm once in 1.7 million checks if the estimate is
// normal, as a sum of more than a thousand bounded terms is.
constexpr double sigmas = 5.0;

inline Object translucent(Shape shape, const Medium& m) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(m.sigma_a);
  material.sigma_s = Spectrum::Constant(m.sigma_s);
  material.g = Spectrum::Constant(m.g);
  material.ior = m.ior;
  material.emission = Spectrum::Constant(m.emission);
  return {"translucent", std::move(shape), material};
}

inline Object diffuse(Shape shape) {
  return {"diffuse", std::move(shape), DiffuseMaterial{Spectrum::Constant(0.5)}};
}

inline DirectionalLight parallel_light(const Vec3& direction, double irradiance) {
  return {direction.normalized(), Spectrum::Constant(irradiance)};
}

inline EnvironmentLight sky(double radiance) {
  return {Spectrum::Constant(radiance), nullptr};
}

// Torus around the z axis, radii 1 and 0.35, of 2 * around * across triangles.
inline TriangleMesh torus_mesh(std::uint32_t around, std::uint32_t across) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  const auto vertex = [=](std::uint32_t i, std::uint32_t j) {
    return (i % around) * across + j % across;
  };
  TriangleMesh torus;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = two_pi * i / around;
      const double b = two_pi * j / across;
      const double rho = 1.0 + 0.35 * std::cos(b);
      torus.vertices.emplace_back(rho * std::cos(a), rho * std::sin(a), 0.35 * std::sin(b));
      torus.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      torus.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return torus;
}

inline std::unique_ptr<RayCaster> caster_of(const Scene& scene) {
  std::vector<const Shape*> shapes;
  for (const Object& object : scene.objects) shapes.push_back(&object.shape);
  return std::make_unique<RayCaster>(shapes);
}

inline Scene scene_of(std::vector<Light> lights, std::vector<Object> objects) {
  Scene scene;
  scene.lights = std::move(lights);
  scene.objects = std::move(objects);
  return scene;
}

inline TraceResult trace(const Scene& scene, TracerOptions::Orders orders, std::size_t photons,
                         bool store = false, int threads = 2, std::uint64_t seed = 1) {
  const auto caster = caster_of(scene);
  Stages stages(false);
  Stage stage(stages, "photons", photons);
  TracerOptions options;
  options.photons = photons;
  options.seed = seed;
  options.orders = orders;
  options.store = store;
  return trace_photons(scene, *caster, 0, options, Workers(threads), stage);
}

}  // namespace knotlight::testing_scenes
