#include "trace/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Irradiance from one light, one overload per kind.
struct IrradianceSampler {
  const Scene& scene;
  const RayCaster& caster;
  const Vec3& position;
  const Vec3& normal;
  Rng& rng;
  double ior;

  // Share of the light from a direction at this cosine that passes the surface.
  double entering(double cosine) const { return 1.0 - fresnel_reflectance(cosine, ior); }

  Spectrum operator()(const PointLight& light) const {
    const Vec3 to_light = light.position - position;
    const double distance = to_light.norm();
    const double cosine = normal.dot(to_light) / distance;
    if (cosine <= 0.0) return Spectrum::Zero();
    return light.intensity * (entering(cosine) * cosine / (distance * distance)) *
           transmittance(scene, caster, position, to_light / distance, distance);
  }

  Spectrum operator()(const DirectionalLight& light) const {
    const double cosine = -normal.dot(light.direction);
    if (cosine <= 0.0) return Spectrum::Zero();
    return light.irradiance * (entering(cosine) * cosine) *
           transmittance(scene, caster, position, -light.direction,
                         std::numeric_limits<double>::infinity());
  }

  // A point of the light with density 1/area per area.
  Spectrum operator()(const AreaLight& light) const {
    const double s = 2.0 * rng.uniform() - 1.0;
    const double t = 2.0 * rng.uniform() - 1.0;
    const Vec3 to_light = light.center + s * light.u + t * light.v - position;
    const double distance = to_light.norm();
    const Vec3 w = to_light / distance;
    const double cosine = normal.dot(w);
    const double cosine_light = -light.normal().dot(w);
    if (cosine <= 0.0 || cosine_light <= 0.0) return Spectrum::Zero();
    return light.radiance *
           (entering(cosine) * light.area() * cosine * cosine_light / (distance * distance)) *
           transmittance(scene, caster, position, w, distance);
  }

  Spectrum operator()(const EnvironmentLight& light) const {
    const double u = rng.uniform();
    const double v = rng.uniform();
    if (light.map == nullptr) {  // constant: density cos/pi per solid angle cancels the cosine
      const Vec3 w = Frame(normal).to_world(sample_cosine_hemisphere(u, v));
      return pi * entering(w.dot(normal)) * light.radiance *
             transmittance(scene, caster, position, w, std::numeric_limits<double>::infinity());
    }
    const EnvironmentMap::Sample sample = light.map->sample(u, v);
    const double cosine = normal.dot(sample.direction);
    if (cosine <= 0.0) return Spectrum::Zero();
    return light.radiance * light.map->radiance(sample.direction) *
           (entering(cosine) * cosine / sample.pdf) *
           transmittance(scene, caster, position, sample.direction,
                         std::numeric_limits<double>::infinity());
  }
};

bool irradiance_is_exact(const Scene& scene) {
  return std::all_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return std::holds_alternative<PointLight>(light) ||
           std::holds_alternative<DirectionalLight>(light);
  });
}

}  // namespace

std::optional<Hit> opaque_contact(const Scene& scene, const RayCaster& caster, const Vec3& p,
                                  const Vec3& d) {
  const double touch = caster.touching_distance();
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].translucent() != nullptr) continue;
    if (auto hit = caster.nearest({p - touch * d, d, 2.0 * touch}, i)) return hit;
  }
  return std::nullopt;
}

Spectrum transmittance(const Scene& scene, const RayCaster& caster, const Vec3& a,
                       const Vec3& direction, double distance) {
  const Ray whole{a, direction, distance - caster.skip_distance()};
  if (!caster.occluded(whole)) return Spectrum::Ones();
  // Something is in the way: go through what is index-matched, one surface at a time.
  Spectrum optical_depth = Spectrum::Zero();
  std::vector<bool> counted(scene.objects.size(), false);
  Ray rest = whole;
  while (const auto hit = caster.nearest(rest)) {
    const TranslucentMaterial* material = scene.objects[hit->object].translucent();
    if (material == nullptr || material->ior != 1.0) return Spectrum::Zero();
    if (!counted[hit->object])
      optical_depth +=
          (material->sigma_a + material->sigma_s) * caster.path_length_inside(whole, hit->object);
    counted[hit->object] = true;
    const bool leaving = direction.dot(hit->normal) > 0.0;
    if (leaving && opaque_contact(scene, caster, hit->position, direction)) return Spectrum::Zero();
    rest.origin = hit->position;
    rest.t_max -= hit->t;
  }
  return (-optical_depth).exp();
}

Spectrum sample_irradiance(const Scene& scene, const RayCaster& caster, const Vec3& position,
                           const Vec3& normal, Rng& rng, double ior) {
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : scene.lights)
    sum += std::visit(IrradianceSampler{scene, caster, position, normal, rng, ior}, light);
  return sum;
}

Spectrum mean_irradiance(const Scene& scene, const RayCaster& caster, const Vec3& position,
                         const Vec3& normal, int samples, Rng& rng, double ior) {
  const int needed = irradiance_is_exact(scene) ? 1 : samples;
  Spectrum sum = Spectrum::Zero();
  for (int i = 0; i < needed; ++i)
    sum += sample_irradiance(scene, caster, position, normal, rng, ior);
  if (!surroundings_reflect(scene)) return sum / needed;
  Spectrum reflected = Spectrum::Zero();
  for (int i = 0; i < samples; ++i)
    reflected += sample_surroundings_irradiance(scene, caster, position, normal, rng, ior);
  return sum / needed + reflected / samples;
}

std::optional<Spectrum> area_light_seen(const Scene& scene, const Ray& ray) {
  double nearest = ray.t_max;
  std::optional<Spectrum> seen;
  for (const Light& light : scene.lights) {
    const auto* area = std::get_if<AreaLight>(&light);
    if (area == nullptr) continue;
    const Vec3 n = area->u.cross(area->v);
    const double facing = n.dot(ray.direction);
    if (facing == 0.0) continue;
    const double t = n.dot(area->center - ray.origin) / facing;
    if (t <= 0.0 || t >= nearest) continue;
    // Coordinates of the meeting point in the basis (u, v).
    const Vec3 offset = ray.origin + t * ray.direction - area->center;
    const double along_u = offset.cross(area->v).dot(n) / n.squaredNorm();
    const double along_v = area->u.cross(offset).dot(n) / n.squaredNorm();
    if (std::abs(along_u) > 1.0 || std::abs(along_v) > 1.0) continue;
    nearest = t;
    seen = facing < 0.0 ? area->radiance : Spectrum(Spectrum::Zero());
  }
  return seen;
}

Spectrum environment_radiance(const Scene& scene, const Vec3& direction) {
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : scene.lights)
    if (const auto* sky = std::get_if<EnvironmentLight>(&light))
      sum += sky->map ? Spectrum(sky->radiance * sky->map->radiance(direction)) : sky->radiance;
  return sum;
}

}  // namespace knotlight
