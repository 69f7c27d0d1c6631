#include "trace/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "trace/light_sample.h"
#include "trace/surroundings.h"

namespace knotlight {

using std::numbers::pi;

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
  for (const Light& light : scene.lights) {
    auto sample = sample_light(light, position, rng);
    if (const auto* sky = std::get_if<EnvironmentLight>(&light); sky && sky->map == nullptr) {
      // Density cos/pi per solid angle, which cancels the cosine.
      const double u = rng.uniform();
      const Vec3 w = Frame(normal).to_world(sample_cosine_hemisphere(u, rng.uniform()));
      sample = LightSample{w, std::numeric_limits<double>::infinity(),
                           pi / w.dot(normal) * sky->radiance};
    }
    const double cosine = sample ? normal.dot(sample->to_light) : 0.0;
    if (cosine <= 0.0) continue;
    sum += sample->irradiance * ((1.0 - fresnel_reflectance(cosine, ior)) * cosine) *
           transmittance(scene, caster, position, sample->to_light, sample->distance);
  }
  return sum;
}

bool irradiance_is_exact(const Scene& scene) {
  return std::all_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return std::holds_alternative<PointLight>(light) ||
           std::holds_alternative<DirectionalLight>(light);
  });
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

Spectrum constant_environment(const Scene& scene) {
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : scene.lights)
    if (const auto* sky = std::get_if<EnvironmentLight>(&light); sky && sky->map == nullptr)
      sum += sky->radiance;
  return sum;
}

Spectrum environment_radiance(const Scene& scene, const Vec3& direction) {
  Spectrum sum = constant_environment(scene);
  for (const Light& light : scene.lights)
    if (const auto* sky = std::get_if<EnvironmentLight>(&light); sky && sky->map != nullptr)
      sum += sky->radiance * sky->map->radiance(direction);
  return sum;
}

}  // namespace knotlight
