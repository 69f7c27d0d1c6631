#include "pipeline/unscattered_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "trace/direct_light.h"
#include "trace/light_sample.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Adds light of `irradiance` (on a plane that faces it) from the unit direction to_light, as it is
// below the surface: of the radiance L outside T ior^2 L is left, in a solid angle that is smaller
// by cos_out / (ior^2 cos_in).
void add(UnscatteredLight& sum, const Spectrum& irradiance, const Vec3& to_light,
         const Vec3& normal, double ior) {
  const double cosine = to_light.dot(normal);
  if (ior == 1.0) {
    sum.U_ri += irradiance / (4.0 * pi);
    sum.F_ri -= irradiance * cosine;
    return;
  }
  if (cosine <= 0.0) return;
  const Spectrum entering = (1.0 - fresnel_reflectance(cosine, ior)) * cosine * irradiance;
  const double cosine_inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
  sum.U_ri += entering / (4.0 * pi * cosine_inside);
  sum.F_ri -= entering;
}

// Radiance against the unit direction w from what lights are not sampled one by one for: skies that
// shine alike from everywhere and diffuse objects.
Spectrum seen_along(const Scene& scene, const RayCaster& caster, const Vec3& x, const Vec3& w,
                    Rng& rng) {
  Ray rest{x, w};
  std::optional<Hit> hit;
  while ((hit = caster.nearest(rest))) {
    const TranslucentMaterial* material = scene.objects[hit->object].translucent();
    if (material == nullptr) break;
    if (material->ior != 1.0) return Spectrum::Zero();
    rest.origin = hit->position;
  }
  if (hit)
    return reflected_radiance(scene, caster, *hit, w, rng) *
           transmittance(scene, caster, x, w, (hit->position - x).dot(w));
  return constant_environment(scene) *
         transmittance(scene, caster, x, w, std::numeric_limits<double>::infinity());
}

}  // namespace

UnscatteredLight unscattered_light(const Scene& scene, const RayCaster& caster, const Hit& hit,
                                   int samples, Rng& rng) {
  const double ior = scene.objects[hit.object].translucent()->ior;
  const bool exact = irradiance_is_exact(scene) && !surroundings_reflect(scene);
  const int needed = exact ? 1 : samples;
  UnscatteredLight sum;
  for (int i = 0; i < needed; ++i) {
    for (const Light& light : scene.lights)
      if (const auto sample = sample_light(light, hit.position, rng))
        add(sum,
            sample->irradiance *
                transmittance(scene, caster, hit.position, sample->to_light, sample->distance),
            sample->to_light, hit.normal, ior);
    if (exact) break;
    const double u = rng.uniform();
    const Vec3 w = sample_sphere(u, rng.uniform());
    add(sum, 4.0 * pi * seen_along(scene, caster, hit.position, w, rng), w, hit.normal, ior);
  }
  return {sum.U_ri / needed, sum.F_ri / needed};
}

}  // namespace knotlight
