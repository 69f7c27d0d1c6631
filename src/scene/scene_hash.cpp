#include "scene/scene_hash.h"

namespace knotlight {

// Structures are taken apart by structured bindings: one that gets another member does not compile
// before its fingerprint knows it.

void SceneHash::add(const Vec3& v) {
  for (const double x : v) add(x);
}

void SceneHash::add(const Spectrum& s) {
  for (const double x : s) add(x);
}

void SceneHash::add(const PointLight& light) {
  const auto& [position, intensity] = light;
  add(position);
  add(intensity);
}

void SceneHash::add(const DirectionalLight& light) {
  const auto& [direction, irradiance] = light;
  add(direction);
  add(irradiance);
}

void SceneHash::add(const AreaLight& light) {
  const auto& [center, u, v, radiance] = light;
  add(center);
  add(u);
  add(v);
  add(radiance);
}

void SceneHash::add(const EnvironmentLight& light) {
  const auto& [radiance, map] = light;
  add(radiance);
  add(map != nullptr);
  if (map == nullptr) return;
  add(map->width());
  for (const Spectrum& pixel : map->pixels()) add(pixel);
}

void SceneHash::add(const Sphere& sphere) {
  const auto& [center, radius] = sphere;
  add(center);
  add(radius);
}

void SceneHash::add(const TriangleMesh& mesh) {
  const auto& [vertices, triangles, colours] = mesh;
  add(vertices.size());
  for (const Vec3& vertex : vertices) add(vertex);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle) add(corner);
  for (const Spectrum& colour : colours) add(colour);
}

void SceneHash::add(const TranslucentMaterial& material) {
  const auto& [sigma_a, sigma_s, g, ior, emission, roughness] = material;
  add(sigma_a);
  add(sigma_s);
  add(g);
  add(ior);
  add(emission);
  add(roughness);
}

void SceneHash::add(const DiffuseMaterial& material) {
  const auto& [reflectance] = material;
  add(reflectance);
}

}  // namespace knotlight
