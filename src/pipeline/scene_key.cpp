#include "pipeline/scene_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/hash.h"

namespace knotlight {
namespace {

// Structures are taken apart by structured bindings: one that gets another member does not compile
// before it is decided here whether solutions depend on it.
class SceneHash {
 public:
  template <typename... T>
  static std::uint64_t of(const T&... items) {
    SceneHash hash;
    (hash.add(items), ...);
    return hash.hash_.value();
  }

 private:
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>
  void add(const T& x) { hash_(x); }
  void add(const Vec3& v) {
    for (const double x : v) add(x);
  }
  void add(const Spectrum& s) {
    for (const double x : s) add(x);
  }
  template <typename T>
  void add(const std::optional<T>& x) {
    add(x.has_value());
    if (x) add(*x);
  }
  template <typename... T>
  void add(const std::variant<T...>& x) {
    add(x.index());
    std::visit([this](const auto& one) { add(one); }, x);
  }

  void add(const PointLight& light) {
    const auto& [position, intensity] = light;
    add(position);
    add(intensity);
  }
  void add(const DirectionalLight& light) {
    const auto& [direction, irradiance] = light;
    add(direction);
    add(irradiance);
  }
  void add(const AreaLight& light) {
    const auto& [center, u, v, radiance] = light;
    add(center);
    add(u);
    add(v);
    add(radiance);
  }
  void add(const EnvironmentLight& light) {
    const auto& [radiance, map] = light;
    add(radiance);
    add(map != nullptr);
    if (map == nullptr) return;
    add(map->width());
    for (const Spectrum& pixel : map->pixels()) add(pixel);
  }

  void add(const Sphere& sphere) {
    const auto& [center, radius] = sphere;
    add(center);
    add(radius);
  }
  void add(const TriangleMesh& mesh) {
    const auto& [vertices, triangles, colours] = mesh;
    add(vertices.size());
    for (const Vec3& vertex : vertices) add(vertex);
    for (const Triangle& triangle : triangles)
      for (const std::uint32_t corner : triangle) add(corner);
    for (const Spectrum& colour : colours) add(colour);
  }

  void add(const TranslucentMaterial& material) {
    const auto& [sigma_a, sigma_s, g, ior, emission, roughness] = material;
    for (const Spectrum& colour : {sigma_a, sigma_s, g, emission}) add(colour);
    add(ior);
    add(roughness);
  }
  void add(const DiffuseMaterial& material) {
    const auto& [reflectance] = material;
    add(reflectance);
  }

  Hash hash_;
};

std::uint64_t hash_of(const BkmThesisSettings& settings) {
  const auto& [knot_layout, interior_knots, radial_function, radial_exponent, radial_order,
               shape_parameter, leave_one_out, basis_order, dense_solver, svd_cut,
               distance_precision] = settings;
  return SceneHash::of(knot_layout, interior_knots, radial_function, radial_exponent, radial_order,
                       shape_parameter, leave_one_out, basis_order, dense_solver, svd_cut,
                       distance_precision);
}

void add_settings(std::vector<KeyPart>& key, const SolverSettings& settings) {
  const auto& [tolerance, source, method, boundary, exitance, diffusion, photons, knots, thesis,
               estimate_photons, divergence, deposits, irradiance_samples, returning_light,
               similarity, estimator, estimate_radius] = settings;
  key.push_back({"solver.tolerance", SceneHash::of(tolerance)});
  key.push_back({"solver.source", SceneHash::of(source)});
  key.push_back({"solver.method", SceneHash::of(method)});
  key.push_back({"solver.boundary", SceneHash::of(boundary)});
  key.push_back({"solver.diffusion (left out: the one that goes with the exitance)",
                 SceneHash::of(diffusion)});
  key.push_back({"solver.photons", SceneHash::of(photons)});
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
