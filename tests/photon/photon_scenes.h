// Small scenes and the trace of them, for the tests of photon/.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <span>
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

inline Object diffuse(Shape shape, double reflectance = 0.0) {
  return {"diffuse", std::move(shape), DiffuseMaterial{Spectrum::Constant(reflectance)}};
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

// sigma_t = b over a thickness of 1.
inline Medium slab_medium(double b, double albedo, double g, double ior) {
  return {b * (1.0 - albedo), b * albedo, g, ior, 0.0};
}

// A slab of thickness 1, 400 wide, lit at right angles through a square hole of slab_beam_area in a
// mask; a detector below (object 1) catches all that is transmitted. An infinite slab answers a
// beam of any cross-section as it does a plane wave: only the totals over its sides count, and the
// box is as good as infinite if nothing gets from the beam's edge, 20 thicknesses, to the sides.
// The slowest mode that spreads sideways in a slab of optical thickness b falls by
// exp(-pi / (1 + 1.42 / b_tr)) per thickness, b_tr = (1 - g albedo) b [CdH53]: with b_tr >= 0.65,
// n = 1, 3e-9 is left; internal reflection at n = 1.5 and b >= 10 lengthens 1.42 to about 5: 1e-18.
constexpr double slab_beam_area = 360.0 * 360.0;
inline Scene slab_scene(const Medium& medium) {
  const auto mask = [](double x, double y, double u, double v) {
    return diffuse(quad_mesh(Vec3(x, y, 3), Vec3(u, 0, 0), Vec3(0, v, 0)));
  };
  return scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                  {translucent(box_mesh(Vec3(-200, -200, 0), Vec3(200, 200, 1)), medium),
                   diffuse(quad_mesh(Vec3(0, 0, -0.1), Vec3(300, 0, 0), Vec3(0, 300, 0))),
                   mask(240, 0, 60, 300), mask(-240, 0, 60, 300), mask(0, 240, 180, 60),
                   mask(0, -240, 180, 60)});
}

inline TraceResult trace(const Scene& scene, TracerOptions::Orders orders, std::size_t photons,
                         bool store = false, int threads = 2, std::uint64_t seed = 1,
                         std::span<FluxTally> fluxes = {}) {
  const auto caster = caster_of(scene);
  Stages stages(false);
  Stage stage(stages, "photons", photons);
  TracerOptions options;
  options.photons = photons;
  options.seed = seed;
  options.orders = orders;
  options.store = store;
  return trace_photons(scene, *caster, 0, options, Workers(threads), stage, fluxes);
}

}  // namespace knotlight::testing_scenes
