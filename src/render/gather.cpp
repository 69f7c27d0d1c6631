#include "render/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/convexity.h"
#include "core/fresnel.h"
#include "core/phase_function.h"
#include "core/sampling.h"
#include "trace/direct_light.h"
#include "trace/light_sample.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Places per ray at which the diffusion solution is looked up: it is smooth, and the rays of one
// pixel place them differently.
constexpr int lookups = 4;
constexpr double invisible = 1e-5;  // share of light that need not be followed further
// Internal reflections along one path; a refracting object of index 1.5 reflects all light beyond
// its critical angle, and only absorption ends that.
constexpr int most_reflections = 64;

// Distance at the share xi of the light that interacts within `length`.
double depth(double xi, double sigma_t, double length) {
  return -std::log1p(xi * std::expm1(-sigma_t * length)) / sigma_t;
}

}  // namespace

Gather::Gather(const Scene& scene, const RayCaster& caster, std::uint32_t object,
               const InsideField& field, OutsideRadiance outside)
    : scene_(scene),
      caster_(caster),
      object_(object),
      material_(*scene.objects[object].translucent()),
      field_(field),
      outside_(std::move(outside)),
      sigma_t_(material_.sigma_a + material_.sigma_s) {
  for (int c = 0; c < 3; ++c) media_.push_back(material_.medium(c));
  const bool shining_sky =
      std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
        const auto* sky = std::get_if<EnvironmentLight>(&light);
        return sky != nullptr && (sky->map == nullptr || material_.ior != 1.0);
      });
  dark_surroundings_ = !shining_sky && scene.objects.size() == 1 &&
                       is_convex(scene.objects[object].shape) && material_.ior == 1.0;
  transient_ = std::any_of(field.channels.begin(), field.channels.end(),
                           [](const auto& channel) { return channel.beyond_p1.has_value(); });
}

Spectrum Gather::radiance(const Ray& ray, const Hit& start, int bounces, double depth_sample,
                          Rng& rng) const {
  double cosine = std::abs(ray.direction.dot(start.normal));
  double bend = curvature(start);
  Spectrum sum = Spectrum::Zero();
  Spectrum weight = Spectrum::Ones();
  Ray segment = ray;
  for (int reflections = 0; reflections < most_reflections; ++reflections) {
    const auto hit = caster_.nearest(segment, object_);
    if (!hit) break;  // grazed an edge: nothing lies behind
    const double cosine_end = std::abs(segment.direction.dot(hit->normal));
    const double bend_end = curvature(*hit);
    sum += weight * along({segment, hit->t, cosine, cosine_end, bend, bend_end}, depth_sample, rng);
    weight *= (-sigma_t_ * hit->t).exp();
    if (weight.maxCoeff() < invisible) break;
    const auto refracted = refract(segment.direction, hit->normal, 1.0 / material_.ior);
    if (refracted && rng.uniform() >= fresnel_reflectance(cosine_end, 1.0 / material_.ior)) {
      sum += weight * material_.ior * material_.ior *
             outside_({{hit->position, *refracted}, bounces, true}, rng);
      break;
    }
    segment = {hit->position, reflect(segment.direction, hit->normal)};
    cosine = cosine_end;
    bend = bend_end;
    depth_sample = rng.uniform();
  }
  return sum;
}

Spectrum Gather::along(const Segment& segment, double depth_sample, Rng& rng) const {
  Spectrum sum;
  for (int c = 0; c < scene_.channels; ++c)
    sum[c] = diffuse(c, segment, depth_sample) - media_[static_cast<std::size_t>(c)].emission /
                                                     (4.0 * pi * sigma_t_[c]) *
                                                     std::expm1(-sigma_t_[c] * segment.length);
  for (int c = scene_.channels; c < 3; ++c) sum[c] = sum[0];
  if (field_.counts_entering_light) return sum;
  return sum + from_lights(segment, depth_sample, rng);
}

// int_0^length sigma_s exp(-sigma_t s) (U_d - g / sigma_tr grad U_d . (-w)) ds without the
// transient part, one stratified sample in each of `lookups` equal shares of the light.
double Gather::diffuse(int channel, const Segment& segment, double depth_sample) const {
  const Medium& medium = media_[static_cast<std::size_t>(channel)];
  const InsideField::Channel& field = field_.channels[static_cast<std::size_t>(channel)];
  double sum = 0.0;
  for (int i = 0; i < lookups; ++i) {
    const double s = depth((i + depth_sample) / lookups, medium.sigma_t(), segment.length);
    const Vec3 x = segment.ray.origin + s * segment.ray.direction;
    if (field.beyond_p1) {
      sum += field.U_d.value(x) * layer(channel, segment, s);
    } else if (medium.g == 0.0) {
      sum += field.U_d.value(x);
    } else {
      const GridField::Sample at = field.U_d.sample(x);
      sum += at.value + medium.g / medium.sigma_tr() * at.gradient.dot(segment.ray.direction);
    }
  }
  const double interacting = -std::expm1(-medium.sigma_t() * segment.length);
  return medium.albedo() * interacting * sum / lookups;
}

// The layer weight of the nearer of the planes that touch the surface at both ends.
double Gather::layer(int channel, const Segment& segment, double s) const {
  const double sigma_t = sigma_t_[channel];
  const double below_begin = s * segment.cosine_begin;
  const double below_end = (segment.length - s) * segment.cosine_end;
  const bool nearer = below_begin <= below_end;
  return field_.surface->layer.weight(
      (nearer ? below_begin : below_end) * sigma_t,
      field_.channels[static_cast<std::size_t>(channel)].k * sigma_t,
      (nearer ? segment.curvature_begin : segment.curvature_end) / sigma_t);
}

double Gather::curvature(const Hit& hit) const {
  if (!field_.surface) return 0.0;
  const SurfaceCurvature& curvature = field_.surface->curvature;
  return curvature.at(hit.primitive, hit.b1, hit.b2) - curvature.median();
}

int Gather::draw_channel(Rng& rng) const {
  return scene_.channels == 1 ? 0 : std::min(static_cast<int>(scene_.channels * rng.uniform()), 2);
}

// The rest of J, at one place on the segment, drawn from the channels in turn and weighted by what
// the mean of their densities is.
Spectrum Gather::from_lights(const Segment& segment, double depth_sample, Rng& rng) const {
  const double s = depth(depth_sample, sigma_t_[draw_channel(rng)], segment.length);
  const Spectrum density =
      sigma_t_ * (-sigma_t_ * s).exp() / (1.0 - (-sigma_t_ * segment.length).exp());
  const Spectrum weight = material_.sigma_s * (-sigma_t_ * s).exp() / density.mean();
  const Vec3 x = segment.ray.origin + s * segment.ray.direction;
  Spectrum light = scattered_once(x, segment.ray.direction, rng);
  if (transient_) light += transient(x, rng);
  return weight * light;
}

// int p L_ri dw', light that is scattered into the view for the first time.
Spectrum Gather::scattered_once(const Vec3& position, const Vec3& view, Rng& rng) const {
  const Spectrum light = lights(position, view, rng);
  return dark_surroundings_ ? light : Spectrum(light + surroundings(position, view, rng));
}

// The transient part of U_d, by one flight in a random direction back to where the light was
// scattered first; inside the surface it may have been reflected.
Spectrum Gather::transient(const Vec3& position, Rng& rng) const {
  const double u = rng.uniform();
  Ray flight{position, sample_sphere(u, rng.uniform())};
  const double r = sample_free_flight(rng.uniform(), sigma_t_[draw_channel(rng)]);
  flight.t_max = r;
  for (int reflections = 0; reflections < most_reflections; ++reflections) {
    const auto hit = caster_.nearest(flight, object_);
    if (!hit) break;
    const double cosine = std::abs(flight.direction.dot(hit->normal));
    if (rng.uniform() >= fresnel_reflectance(cosine, 1.0 / material_.ior)) return Spectrum::Zero();
    flight = {hit->position, reflect(flight.direction, hit->normal), flight.t_max - hit->t};
  }
  const Spectrum passed = (-sigma_t_ * r).exp();
  Spectrum weight = passed / (sigma_t_ * passed).mean();
  for (int c = 0; c < 3; ++c) {
    const auto& field =
        field_.channels[static_cast<std::size_t>(std::min(c, scene_.channels - 1))].beyond_p1;
    weight[c] *= field ? field->epsilon(sigma_t_[c] * r) : 0.0;
  }
  const Vec3 first = flight.origin + flight.t_max * flight.direction;
  return weight * (material_.sigma_s * scattered_once(first, flight.direction, rng) +
                   material_.emission / (4.0 * pi));
}

// What one unit of irradiance from a direction sends to the eye, 1/sr; cosine between the
// directions of the light and of the view ray as seen from the place. The phase function, and the
// flux Q_ri / sigma_tr in F_d.
Spectrum Gather::scattering(double cosine) const {
  Spectrum result;
  for (int c = 0; c < 3; ++c) {
    const Medium& medium = media_[static_cast<std::size_t>(c)];
    const double flux = medium.g == 0.0 ? 0.0
                                        : 3.0 * medium.g * medium.g * medium.sigma_s /
                                              (4.0 * pi * medium.sigma_tr()) * cosine;
    result[c] = henyey_greenstein(cosine, medium.g) + flux;
  }
  return result;
}

Spectrum Gather::lights(const Vec3& position, const Vec3& view, Rng& rng) const {
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : scene_.lights) {
    if (const auto sample = sample_light(light, position, rng))
      sum += scattering(sample->to_light.dot(view)) * sample->irradiance *
             transmittance(scene_, caster_, position, sample->to_light, sample->distance);
  }
  return sum;
}

// Everything else that shines into the object, met by going where the phase function leads.
Spectrum Gather::surroundings(const Vec3& position, const Vec3& view, Rng& rng) const {
  const double u = rng.uniform();
  const Vec3 w = sample_henyey_greenstein(view, media_[0].g, u, rng.uniform());
  const double cosine = w.dot(view);
  return scattering(cosine) / henyey_greenstein(cosine, media_[0].g) * arriving({position, w}, rng);
}

// Unscattered radiance that arrives at ray.origin inside the object from where the ray leads.
Spectrum Gather::arriving(Ray ray, Rng& rng) const {
  Spectrum weight = Spectrum::Ones();
  for (int reflections = 0; reflections < most_reflections; ++reflections) {
    const auto hit = caster_.nearest(ray, object_);
    if (!hit) break;
    weight *= (-sigma_t_ * hit->t).exp();
    if (weight.maxCoeff() < invisible) break;
    const auto refracted = refract(ray.direction, hit->normal, 1.0 / material_.ior);
    const double reflectance =
        fresnel_reflectance(std::abs(ray.direction.dot(hit->normal)), 1.0 / material_.ior);
    if (refracted && rng.uniform() >= reflectance)
      return weight * material_.ior * material_.ior *
             outside_({{hit->position, *refracted}, 0, false}, rng);
    ray = {hit->position, reflect(ray.direction, hit->normal)};
  }
  return Spectrum::Zero();
}

}  // namespace knotlight
