#include "render/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "trace/direct_light.h"

namespace knotlight {
namespace {

constexpr double invisible = 1e-5;  // of the light behind an object
// Rays to the lights per camera ray where the light that enters has to come off U (boundary_flux).
constexpr int entering_samples = 16;
constexpr int mirror_bounces = 4;      // R^4 < 1e-5 away from grazing angles
constexpr double crease_cosine = 0.7;  // facets within 45 degrees are shaded as one smooth surface
// Smoothed normals can face away from the eye at silhouettes; leaving light then takes this cosine.
constexpr double least_cosine = 1e-3;

}  // namespace

Shading::Shading(const Scene& scene, const RayCaster& caster, const GlowingSurfaces& surfaces)
    : scene_(scene), caster_(caster), surfaces_(surfaces) {
  for (const Object& object : scene.objects) {
    const auto* mesh = std::get_if<TriangleMesh>(&object.shape);
    smooth_normals_.push_back(mesh != nullptr && object.translucent() != nullptr
                                  ? smooth_corner_normals(*mesh, crease_cosine)
                                  : std::vector<Vec3>());
  }
}

Spectrum Shading::radiance(const Ray& ray, Rng& rng) const {
  return radiance(ray, mirror_bounces, rng);
}

Spectrum Shading::radiance(const Ray& ray, int bounces, Rng& rng) const {
  const auto hit = caster_.nearest(ray);
  const double distance = hit ? hit->t : ray.t_max;
  if (const auto light = area_light_seen(scene_, {ray.origin, ray.direction, distance}))
    return *light;
  if (!hit) return environment_radiance(scene_, ray.direction);
  const Object& object = scene_.objects[hit->object];
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&object.material)) {
    const Vec3 n = hit->normal.dot(ray.direction) < 0.0 ? hit->normal : Vec3(-hit->normal);
    return diffuse->reflectance / std::numbers::pi *
           sample_irradiance(scene_, caster_, hit->position, n, rng);
  }
  return translucent_radiance(ray, *hit, *object.translucent(), bounces, rng);
}

// Light that leaves the object, and the mirror image of the surroundings in its surface.
Spectrum Shading::translucent_radiance(const Ray& ray, const Hit& hit,
                                       const TranslucentMaterial& material, int bounces,
                                       Rng& rng) const {
  const Vec3 n = shading_normal(hit);
  const double cosine = std::clamp(-n.dot(ray.direction), least_cosine, 1.0);
  const GlowingSurface& surface = *surfaces_[hit.object];
  const Spectrum entered =
      surface.counts_entering_light
          ? mean_irradiance(scene_, caster_, hit.position, n, entering_samples, rng, material.ior)
          : Spectrum(Spectrum::Zero());
  Spectrum light;
  for (int c = 0; c < 3; ++c) {
    const auto channel = static_cast<std::size_t>(std::min(c, scene_.channels - 1));
    const double U_d = surface.grid.interpolate(surface.U_d[channel], hit) -
                       DiffusionCoefficients::boundary_flux_U_ri(entered[c]);
    light[c] = surface.leaving[channel](U_d, cosine);
  }
  if (material.ior == 1.0) return light + seen_through(ray, hit, material, bounces, rng);
  const double reflectance = fresnel_reflectance(cosine, material.ior);
  if (reflectance == 0.0 || bounces == 0) return light;
  const Vec3 mirrored = reflect(ray.direction, n);
  if (mirrored.dot(hit.normal) <= 0.0) return light;  // into the facet: smoothing's artefact
  return light + reflectance * radiance({hit.position, mirrored}, bounces - 1, rng);
}

// What lies behind an index-matched object, weakened by exp(-sigma_t length). (A refracting one
// bends and mirrors the ray many times; it is taken as opaque to unscattered light.)
Spectrum Shading::seen_through(const Ray& ray, const Hit& hit, const TranslucentMaterial& material,
                               int bounces, Rng& rng) const {
  const auto way_out = caster_.nearest({hit.position, ray.direction}, hit.object);
  if (!way_out || bounces == 0) return Spectrum::Zero();
  const Spectrum passed = (-(material.sigma_a + material.sigma_s) * way_out->t).exp();
  if (passed.maxCoeff() < invisible) return Spectrum::Zero();
  return passed * radiance({way_out->position, ray.direction}, bounces - 1, rng);
}

Vec3 Shading::shading_normal(const Hit& hit) const {
  const std::vector<Vec3>& normals = smooth_normals_[hit.object];
  if (normals.empty()) return hit.normal;
  const Vec3* corner = &normals[3 * static_cast<std::size_t>(hit.primitive)];
  return ((1.0 - hit.b1 - hit.b2) * corner[0] + hit.b1 * corner[1] + hit.b2 * corner[2])
      .normalized();
}

}  // namespace knotlight
