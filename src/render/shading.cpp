#include "render/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/microfacet.h"
#include "core/per_channel.h"
#include "core/sampling.h"
#include "trace/direct_light.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

// Rays to the lights per camera ray where the light that enters has to come off U (boundary_flux).
constexpr int entering_samples = 16;
constexpr int most_bounces = 4;        // R^4 < 1e-5 away from grazing angles
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
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    gathers_.emplace_back();
    if (surfaces[i] && !surfaces[i]->inside.channels.empty())
      gathers_.back().emplace(
          scene, caster, i, surfaces[i]->inside, [this](const OutsideRay& ray, Rng& rng) {
            return radiance(ray.ray, {ray.bounces, ray.seen, rng.uniform(), ray.leaving}, rng);
          });
  }
}

Spectrum Shading::radiance(const Ray& ray, double depth_sample, Rng& rng,
                           ScatteredLight* scattered) const {
  return radiance(ray, {most_bounces, true, depth_sample, false, scattered}, rng);
}

Spectrum Shading::radiance(const Ray& ray, const Look& look, Rng& rng) const {
  auto hit = look.leaving ? opaque_contact(scene_, caster_, ray.origin, ray.direction)
                          : std::optional<Hit>();
  if (!hit) hit = caster_.nearest(ray);
  const double distance = hit ? std::max(hit->t, 0.0) : ray.t_max;
  if (const auto light = area_light_seen(scene_, {ray.origin, ray.direction, distance}))
    return look.seen ? *light : Spectrum(Spectrum::Zero());
  if (!hit)
    return look.seen ? environment_radiance(scene_, ray.direction) : constant_environment(scene_);
  const Object& object = scene_.objects[hit->object];
  if (std::holds_alternative<DiffuseMaterial>(object.material)) {
    const Spectrum light = reflected_radiance(scene_, caster_, *hit, ray.direction, rng);
    return light + glow_reflected(*hit, ray.direction, rng);
  }
  return translucent_radiance(ray, *hit, *object.translucent(), look, rng);
}

// What a diffuse surface reflects of the light that leaves translucent objects: one direction.
Spectrum Shading::glow_reflected(const Hit& hit, const Vec3& direction, Rng& rng) const {
  const Vec3 n = hit.normal.dot(direction) < 0.0 ? hit.normal : Vec3(-hit.normal);
  const double u = rng.uniform();
  const Ray ray{hit.position, Frame(n).to_world(sample_cosine_hemisphere(u, rng.uniform()))};
  const auto met = caster_.nearest(ray);
  if (!met) return Spectrum::Zero();
  const TranslucentMaterial* material = scene_.objects[met->object].translucent();
  if (material == nullptr) return Spectrum::Zero();
  const Vec3 normal = shading_normal(*met);
  const double cosine = std::clamp(-normal.dot(ray.direction), least_cosine, 1.0);
  return reflectance_at(scene_.objects[hit.object], hit) *
         surface_radiance(*met, normal, cosine, *material, rng);
}

// Light that leaves the object, and the mirror image of the surroundings in its surface.
Spectrum Shading::translucent_radiance(const Ray& ray, const Hit& hit,
                                       const TranslucentMaterial& material, const Look& look,
                                       Rng& rng) const {
  const Vec3 n = shading_normal(hit);
  const double cosine = std::clamp(-n.dot(ray.direction), least_cosine, 1.0);
  if (!look.seen) return surface_radiance(hit, n, cosine, material, rng);
  // A rough surface sends the view ray one way or the other; a smooth one both.
  double reflectance = fresnel_reflectance(cosine, material.ior);
  Vec3 mirrored = reflect(ray.direction, n);
  auto inwards = refract(ray.direction, n, material.ior);
  if (material.alpha() > 0.0) {
    const SurfaceEvent event =
        cross_rough_surface(ray.direction, n, material.ior, material.alpha(), rng);
    reflectance = event.transmitted ? 0.0 : 1.0;
    if (event.transmitted)
      inwards = event.direction;
    else
      mirrored = event.direction;
  }
  Spectrum light = Spectrum::Zero();
  if (!gathers_[hit.object]) {
    light = surface_radiance(hit, n, cosine, material, rng);
    if (const auto& once = surfaces_[hit.object]->once_scattered)
      light += once(ray, hit, n, look.depth_sample, rng);
    if (material.ior == 1.0) light += seen_through(ray, hit, material, look, rng);
  } else if (reflectance < 1.0) {
    // Smoothed normals may refract through the facet's back.
    if (!inwards || inwards->dot(hit.normal) >= 0.0)
      inwards = refract(ray.direction, hit.normal, material.ior);
    const double leaving = (1.0 - reflectance) / (material.ior * material.ior);
    const GatheredRadiance inside = gathers_[hit.object]->radiance(
        {hit.position, *inwards}, hit, std::max(look.bounces - 1, 0), look.depth_sample, rng);
    light = leaving * inside.sum();
    if (look.scattered != nullptr) {
      look.scattered->once += leaving * inside.once;
      look.scattered->more += leaving * inside.more;
    }
  }
  if (reflectance == 0.0 || look.bounces == 0) return light;
  // Smoothed normals may mirror into the facet.
  if (mirrored.dot(hit.normal) <= 0.0) mirrored = reflect(ray.direction, hit.normal);
  return light + reflectance * radiance({hit.position, mirrored},
                                        {look.bounces - 1, true, rng.uniform()}, rng);
}

// From the field on the surface alone.
Spectrum Shading::surface_radiance(const Hit& hit, const Vec3& normal, double cosine,
                                   const TranslucentMaterial& material, Rng& rng) const {
  const GlowingSurface& surface = *surfaces_[hit.object];
  const Spectrum entered = surface.inside.counts_entering_light
                               ? mean_irradiance(scene_, caster_, hit.position, normal,
                                                 entering_samples, rng, material.ior)
                               : Spectrum(Spectrum::Zero());
  return per_channel(scene_.channels, [&](int c) {
    const auto channel = static_cast<std::size_t>(c);
    const double U_d = surface.grid.interpolate(surface.U_d[channel], hit) -
                       DiffusionCoefficients::boundary_flux_U_ri(entered[c]);
    return surface.leaving[channel](U_d, cosine);
  });
}

Spectrum Shading::solution_at(const Hit& hit, int samples, Rng& rng) const {
  const GlowingSurface& surface = *surfaces_[hit.object];
  const auto& gather = gathers_[hit.object];
  bool transient = false;
  Spectrum U = per_channel(scene_.channels, [&](int c) {
    const auto channel = static_cast<std::size_t>(c);
    const double value = surface.grid.interpolate(surface.U_d[channel], hit);
    if (!gather || !surface.inside.channels[channel].beyond_p1) return value;
    transient = true;
    return value * gather->surface_weight(c, hit);
  });
  if (!transient) return U;
  Spectrum sum = Spectrum::Zero();
  for (int i = 0; i < samples; ++i) sum += gather->transient(hit.position, rng);
  return U + sum / samples;
}

// What lies behind an index-matched object, weakened by exp(-sigma_t length). (A refracting one
// bends and mirrors the ray many times; it is taken as opaque to unscattered light.)
Spectrum Shading::seen_through(const Ray& ray, const Hit& hit, const TranslucentMaterial& material,
                               const Look& look, Rng& rng) const {
  const auto way_out = caster_.nearest({hit.position, ray.direction}, hit.object);
  if (!way_out || look.bounces == 0) return Spectrum::Zero();
  const Spectrum passed = (-(material.sigma_a + material.sigma_s) * way_out->t).exp();
  if (passed.maxCoeff() < invisible) return Spectrum::Zero();
  return passed * radiance({way_out->position, ray.direction},
                           {look.bounces - 1, true, rng.uniform(), true}, rng);
}

Vec3 Shading::shading_normal(const Hit& hit) const {
  const std::vector<Vec3>& normals = smooth_normals_[hit.object];
  if (normals.empty()) return hit.normal;
  const Vec3* corner = &normals[3 * static_cast<std::size_t>(hit.primitive)];
  return ((1.0 - hit.b1 - hit.b2) * corner[0] + hit.b1 * corner[1] + hit.b2 * corner[2])
      .normalized();
}

}  // namespace knotlight
