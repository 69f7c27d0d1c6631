#include "rivals/once_scattered.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fresnel.h"
#include "core/phase_function.h"
#include "trace/direct_light.h"
#include "trace/light_sample.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

// Where light is scattered into the view, and all that its way there depends on.
struct Scattering {
  const Scene& scene;
  const RayCaster& caster;
  const TranslucentMaterial& material;
  std::uint32_t object;
  Vec3 position;
  Vec3 view;  // unit, along the refracted view ray
};

// Where a straight line from the place of scattering leaves the object.
std::optional<Hit> way_out(const Scattering& at, const Vec3& direction) {
  auto hit = at.caster.nearest({at.position, direction}, at.object);
  // So near to the surface that the ray is outside already.
  if (hit && direction.dot(hit->normal) <= 0.0) hit.reset();
  return hit;
}

// What comes of light that arrives outside from `to_light`, per channel: Fresnel transmittance,
// refraction, extinction in the object and phase function, 1/sr. exit: way_out; inside: length of
// the part of the line that lies in the object.
Spectrum scattered_part(const Scattering& at, const Vec3& to_light, const std::optional<Hit>& exit,
                        double inside) {
  const TranslucentMaterial& m = at.material;
  Vec3 arriving = -to_light;
  double entering = 1.0;
  if (exit && m.ior != 1.0) {
    const double cosine = std::min(1.0, to_light.dot(exit->normal));
    const double cosine_in = std::sqrt(1.0 - (1.0 - cosine * cosine) / (m.ior * m.ior));
    entering = (1.0 - fresnel_reflectance(cosine, m.ior)) * cosine / cosine_in;
    inside *= cosine / cosine_in;
    arriving = refract(arriving, exit->normal, m.ior).value_or(arriving);
  }
  // Light travels along `arriving` and leaves against the view.
  const double turned = -arriving.dot(at.view);
  Spectrum part;
  for (int c = 0; c < 3; ++c)
    part[c] = entering * henyey_greenstein(turned, m.g[c]) *
              std::exp(-(m.sigma_a[c] + m.sigma_s[c]) * inside);
  return part;
}

Spectrum from_lights(const Scattering& at, Rng& rng) {
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : at.scene.lights) {
    const auto sample = sample_light(light, at.position, rng);
    if (!sample) continue;
    auto exit = way_out(at, sample->to_light);
    double inside = exit ? exit->t : 0.0;
    Spectrum passed = Spectrum::Ones();
    if (inside < sample->distance) {
      passed = transmittance(at.scene, at.caster, exit ? exit->position : at.position,
                             sample->to_light, sample->distance - inside);
    } else {  // a lamp in the object
      inside = sample->distance;
      exit.reset();
    }
    sum += sample->irradiance * passed * scattered_part(at, sample->to_light, exit, inside);
  }
  return sum;
}

// The constant sky and diffuse objects, by one direction that the first channel's phase function
// draws. Of diffuse objects those in plain sight.
Spectrum from_surroundings(const Scattering& at, Rng& rng) {
  const double g = at.material.g[0];
  const double u = rng.uniform();
  const Vec3 w = sample_henyey_greenstein(at.view, g, u, rng.uniform());
  const auto exit = way_out(at, w);
  const Vec3 from = exit ? exit->position : at.position;
  auto met = opaque_contact(at.scene, at.caster, from, w);
  if (!met) met = at.caster.nearest({from, w});
  Spectrum radiance = constant_environment(at.scene);
  if (met && at.scene.objects[met->object].translucent() == nullptr)
    radiance = reflected_radiance(at.scene, at.caster, *met, w, rng);
  else if (met)
    radiance *=
        transmittance(at.scene, at.caster, from, w, std::numeric_limits<double>::infinity());
  return radiance * scattered_part(at, w, exit, exit ? exit->t : 0.0) /
         henyey_greenstein(w.dot(at.view), g);
}

}  // namespace

Spectrum once_scattered(const Scene& scene, const RayCaster& caster, const Ray& ray, const Hit& hit,
                        const Vec3& normal, double depth_sample, Rng& rng) {
  const TranslucentMaterial& material = *scene.objects[hit.object].translucent();
  const double cosine = std::min(1.0, std::abs(normal.dot(ray.direction)));
  auto inwards = refract(ray.direction, normal, material.ior);
  // Smoothed normals may refract through the facet's back.
  if (!inwards || inwards->dot(hit.normal) >= 0.0)
    inwards = refract(ray.direction, hit.normal, material.ior);
  const auto end = caster.nearest({hit.position, *inwards}, hit.object);
  if (!end) return Spectrum::Zero();  // grazed an edge
  // The depth is drawn from the law of one channel, and weighted by the mean of their densities.
  const Spectrum sigma_t = material.sigma_a + material.sigma_s;
  const int channel =
      scene.channels == 1 ? 0 : std::min(static_cast<int>(scene.channels * rng.uniform()), 2);
  const double s =
      -std::log1p(depth_sample * std::expm1(-sigma_t[channel] * end->t)) / sigma_t[channel];
  const Spectrum passed = (-sigma_t * s).exp();
  const Spectrum interacting =
      (sigma_t * end->t).unaryExpr([](double tau) { return -std::expm1(-tau); });
  const Spectrum density = sigma_t * passed / interacting;
  const Scattering at{scene, caster, material, hit.object, hit.position + s * *inwards, *inwards};
  Spectrum light = from_lights(at, rng);
  if ((constant_environment(scene) > 0.0).any() || surroundings_reflect(scene))
    light += from_surroundings(at, rng);
  const double leaving =
      (1.0 - fresnel_reflectance(cosine, material.ior)) / (material.ior * material.ior);
  return leaving * material.sigma_s * passed / density.mean() * light;
}

}  // namespace knotlight
