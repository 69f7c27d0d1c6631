#include "pipeline/scene_key.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/scene_hash.h"

namespace knotlight {
namespace {

// Taken apart by structured bindings, as in scene/scene_hash.cpp: settings that get another member
// do not compile before it is decided here whether solutions depend on it.
std::uint64_t hash_of(const BkmThesisSettings& settings) {
  const auto& [knot_layout, interior_knots, radial_function, radial_exponent, radial_order,
               shape_parameter, leave_one_out, basis_order, dense_solver, svd_cut,
               distance_precision] = settings;
  return SceneHash::of(knot_layout, interior_knots, radial_function, radial_exponent, radial_order,
                       shape_parameter, leave_one_out, basis_order, dense_solver, svd_cut,
                       distance_precision);
}

void add_settings(std::vector<KeyPart>& key, const SolverSettings& settings) {
  const auto& [tolerance, source, method, boundary, exitance, diffusion, photons, photons_at_most,
               knots, thesis, estimate_photons, divergence, deposits, irradiance_samples,
               returning_light, similarity, estimator, estimate_radius] = settings;
  key.push_back({"solver.tolerance", SceneHash::of(tolerance)});
  key.push_back({"solver.source", SceneHash::of(source)});
  key.push_back({"solver.method", SceneHash::of(method)});
  key.push_back({"solver.boundary", SceneHash::of(boundary)});
  key.push_back({"solver.diffusion (left out: the one that goes with the exitance)",
                 SceneHash::of(diffusion)});
  key.push_back({"solver.photons", SceneHash::of(photons, photons_at_most)});
  key.push_back({"solver.knots", SceneHash::of(knots)});
  key.push_back({"solver's keys of bkm_thesis", hash_of(thesis)});
  key.push_back({"solver.estimate_photons", SceneHash::of(estimate_photons)});
  key.push_back({"solver.divergence", SceneHash::of(divergence)});
  key.push_back({"solver.deposits", SceneHash::of(deposits)});
  key.push_back({"solver.irradiance_samples", SceneHash::of(irradiance_samples)});
  key.push_back({"solver.returning_light", SceneHash::of(returning_light)});
  key.push_back({"solver.similarity", SceneHash::of(similarity)});
  key.push_back({"solver.estimator", SceneHash::of(estimator)});
  key.push_back({"solver.estimate_radius", SceneHash::of(estimate_radius)});
}

}  // namespace

std::vector<KeyPart> solution_key(const Scene& scene, std::uint64_t seed) {
  std::vector<KeyPart> key;
  key.push_back({"units", SceneHash::of(scene.units)});
  key.push_back({"the seed", SceneHash::of(seed)});
  key.push_back({"the number of channels", SceneHash::of(scene.channels)});
  key.push_back({"the number of lights", SceneHash::of(scene.lights.size())});
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    key.push_back({fmt::format("lights.{}", i), SceneHash::of(scene.lights[i])});
  key.push_back({"the number of objects", SceneHash::of(scene.objects.size())});
  for (const Object& object : scene.objects) {
    key.push_back({fmt::format("the shape of object '{}'", object.name),
                   SceneHash::of(object.name, object.shape)});
    key.push_back(
        {fmt::format("the material of object '{}'", object.name), SceneHash::of(object.material)});
  }
  add_settings(key, scene.solver);
  return key;
}

std::string first_difference(const std::vector<KeyPart>& a, const std::vector<KeyPart>& b) {
  const auto same = [](const KeyPart& x, const KeyPart& y) {
    return x.name == y.name && x.value == y.value;
  };
  const auto [at_a, at_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end(), same);
  if (at_a != a.end()) return at_a->name;
  return at_b != b.end() ? at_b->name : "";
}

}  // namespace knotlight
