#include "render/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/convexity.h"
#include "core/fresnel.h"
#include "core/per_channel.h"
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
// Internal reflections along one path; a refracting object of index 1.5 reflects all light beyond
// its critical angle, and only absorption ends that.
constexpr int most_reflections = 64;

std::vector<Medium> media_of(const TranslucentMaterial& material) {
  return {material.medium(0), material.medium(1), material.medium(2)};
}

std::vector<Medium> media_of(const InsideField& field) {
  std::vector<Medium> media;
  for (std::size_t c = 0; c < 3; ++c)
    media.push_back(field.channels[std::min(c, field.channels.size() - 1)].medium);
  return media;
}

// Distance at the share xi of the light that interacts within `length`.
double depth(double xi, double sigma_t, double length) {
  return -std::log1p(xi * std::expm1(-sigma_t * length)) / sigma_t;
}

}  // namespace

Gather::Optics::Optics(std::vector<Medium> m) : media(std::move(m)) {
  for (int c = 0; c < 3; ++c) {
    sigma_s[c] = media[static_cast<std::size_t>(c)].sigma_s;
    sigma_t[c] = media[static_cast<std::size_t>(c)].sigma_t();
  }
}

Gather::Gather(const Scene& scene, const RayCaster& caster, std::uint32_t object,
               const InsideField& field, OutsideRadiance outside)
    : scene_(scene),
      caster_(caster),
      object_(object),
      material_(*scene.objects[object].translucent()),
      field_(field),
      outside_(std::move(outside)),
      once_(media_of(material_)),
      multiply_(media_of(field)) {
  dark_surroundings_ = (constant_environment(scene) == 0.0).all() && scene.objects.size() == 1 &&
                       is_convex(scene.objects[object].shape);
  transient_ = std::any_of(field.channels.begin(), field.channels.end(),
                           [](const auto& channel) { return channel.beyond_p1.has_value(); });
  const auto scatters_unlike = [&](int c) {
    return once_.media[static_cast<std::size_t>(c)].g !=
           multiply_.media[static_cast<std::size_t>(c)].g;
  };
  // Under a refracting surface the half-spaces would have to have one too.
  if (transient_ && material_.ior == 1.0 &&
      (scatters_unlike(0) || scatters_unlike(1) || scatters_unlike(2)))
    for (std::size_t c = 0; c < static_cast<std::size_t>(scene.channels); ++c)
      reflections_.push_back({{once_.media[c].albedo(), once_.media[c].g},
                              {multiply_.media[c].albedo(), multiply_.media[c].g}});
}

GatheredRadiance Gather::radiance(const Ray& ray, const Hit& start, int bounces,
                                  double depth_sample, Rng& rng) const {
  double cosine = std::abs(ray.direction.dot(start.normal));
  double bend = curvature(start);
  GatheredRadiance light;
  Spectrum unscattered = Spectrum::Ones();  // share of light that comes so far, in either medium
  Spectrum passed = Spectrum::Ones();
  Ray ahead = ray;
  if (!reflections_.empty() && !field_.counts_entering_light)
    light.more += reflected_beyond_similar(ray, start, rng);
  for (int reflections = 0; reflections < most_reflections; ++reflections) {
    const auto hit = caster_.nearest(ahead, object_);
    if (!hit) break;  // grazed an edge: nothing lies behind
    const double cosine_end = std::abs(ahead.direction.dot(hit->normal));
    const double bend_end = curvature(*hit);
    const Segment segment{ahead, hit->t, cosine, cosine_end, bend, bend_end};
    light.more += passed * diffuse(segment, depth_sample);
    if (!field_.counts_entering_light) {
      // U_ri by the photons is that of the medium they were traced in.
      const bool by_photons = field_.channels.front().U_ri.has_value();
      const Optics& first = by_photons ? multiply_ : once_;
      light.once += (by_photons ? passed : unscattered) *
                    sampled(segment, first, depth_sample, rng, [&](const Vec3& x) {
                      return scattered_once(x, ahead.direction, first, rng);
                    });
      if (transient_)
        light.more += passed * sampled(segment, multiply_, depth_sample, rng,
                                       [&](const Vec3& x) { return transient(x, rng); });
    }
    unscattered *= (-once_.sigma_t * hit->t).exp();
    passed *= (-multiply_.sigma_t * hit->t).exp();
    if (std::max(passed.maxCoeff(), unscattered.maxCoeff()) < invisible) break;
    const auto refracted = refract(ahead.direction, hit->normal, 1.0 / material_.ior);
    if (refracted && rng.uniform() >= fresnel_reflectance(cosine_end, 1.0 / material_.ior)) {
      if (unscattered.maxCoeff() >= invisible)
        light.behind += unscattered * material_.ior * material_.ior *
                        outside_({{hit->position, *refracted}, bounces, true, true}, rng);
      break;
    }
    ahead = {hit->position, reflect(ahead.direction, hit->normal)};
    cosine = cosine_end;
    bend = bend_end;
    depth_sample = rng.uniform();
  }
  return light;
}

// int_0^length exp(-sigma_t s) (sigma_s U_d + E / 4 pi) ds without the transient part.
Spectrum Gather::diffuse(const Segment& segment, double depth_sample) const {
  return per_channel(scene_.channels, [&](int c) {
    const Medium& medium = multiply_.media[static_cast<std::size_t>(c)];
    const double interacting = -std::expm1(-medium.sigma_t() * segment.length);
    return interacting * (medium.albedo() * mean_U_d(c, segment, depth_sample) +
                          medium.emission / (4.0 * pi * medium.sigma_t()));
  });
}

// Over the share of the light that interacts on the segment: one stratified sample in each of
// `lookups` equal parts of it.
double Gather::mean_U_d(int channel, const Segment& segment, double depth_sample) const {
  const double sigma_t = multiply_.sigma_t[channel];
  const InsideField::Channel& field = field_.channels[static_cast<std::size_t>(channel)];
  double sum = 0.0;
  for (int i = 0; i < lookups; ++i) {
    const double s = depth((i + depth_sample) / lookups, sigma_t, segment.length);
    // A ray that has slipped through an edge of the mesh finds nothing outside.
    const double U_d = field.U_d.value_or_nothing(segment.ray.origin + s * segment.ray.direction);
    sum += field.beyond_p1 ? U_d * layer(channel, segment, s) : U_d;
  }
  return sum / lookups;
}

// The layer weight of the nearer of the planes that touch the surface at both ends.
double Gather::layer(int channel, const Segment& segment, double s) const {
  const double sigma_t = multiply_.sigma_t[channel];
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

// int_0^length exp(-sigma_t s) sigma_s light(x(s)) ds, at one place on the segment, drawn from the
// channels in turn and weighted by what the mean of their densities is.
template <class Light>
Spectrum Gather::sampled(const Segment& segment, const Optics& optics, double depth_sample,
                         Rng& rng, const Light& light) const {
  const Spectrum& sigma_t = optics.sigma_t;
  const double s = depth(depth_sample, sigma_t[draw_channel(rng)], segment.length);
  const Spectrum passed = (-sigma_t * s).exp();
  const Spectrum interacting =
      (sigma_t * segment.length).unaryExpr([](double tau) { return -std::expm1(-tau); });
  const Spectrum density = sigma_t * passed / interacting;
  return optics.sigma_s * passed / density.mean() *
         light(segment.ray.origin + s * segment.ray.direction);
}

// int p L_ri dw', light that is scattered into the view for the first time.
Spectrum Gather::scattered_once(const Vec3& position, const Vec3& view, const Optics& optics,
                                Rng& rng) const {
  if (field_.channels.front().U_ri)
    return per_channel(scene_.channels, [&](int c) {
      return field_.channels[static_cast<std::size_t>(c)].U_ri->value_or_nothing(position);
    });
  const Spectrum light = lights(position, view, optics, rng);
  return dark_surroundings_ ? light : Spectrum(light + surroundings(position, view, optics, rng));
}

// Where a ray from inside leaves the object. Nothing from a place so near the surface that the ray
// is outside already.
std::optional<Hit> Gather::way_out(const Ray& ray) const {
  auto hit = caster_.nearest(ray, object_);
  if (hit && ray.direction.dot(hit->normal) <= 0.0) hit.reset();
  return hit;
}

// The transient part of U_d, by one flight in a random direction back to where the light was
// scattered first; inside the surface it may have been reflected.
Spectrum Gather::transient(const Vec3& position, Rng& rng) const {
  const Spectrum& sigma_t = multiply_.sigma_t;
  const double u = rng.uniform();
  Ray flight{position, sample_sphere(u, rng.uniform())};
  const double r = sample_free_flight(rng.uniform(), sigma_t[draw_channel(rng)]);
  double left = r;
  for (int reflections = 0; reflections < most_reflections; ++reflections) {
    const auto hit = way_out(flight);
    if (!hit) return Spectrum::Zero();
    if (hit->t >= left) break;
    const double cosine = flight.direction.dot(hit->normal);
    if (rng.uniform() >= fresnel_reflectance(cosine, 1.0 / material_.ior)) return Spectrum::Zero();
    flight = {hit->position, reflect(flight.direction, hit->normal)};
    left -= hit->t;
  }
  const Spectrum passed = (-sigma_t * r).exp();
  const Spectrum epsilon = per_channel(scene_.channels, [&](int c) {
    const auto& field = field_.channels[static_cast<std::size_t>(c)].beyond_p1;
    return field ? field->epsilon(sigma_t[c] * r) : 0.0;
  });
  const Spectrum weight = passed / (sigma_t * passed).mean() * epsilon;
  const Vec3 first = flight.origin + left * flight.direction;
  return weight * (multiply_.sigma_s * scattered_once(first, flight.direction, multiply_, rng) +
                   material_.emission / (4.0 * pi));
}

// What a half-space lit as the surface is at `hit` reflects by light scattered at least twice, over
// what one of the similar medium does: the first few scatterings of a forward peak.
Spectrum Gather::reflected_beyond_similar(const Ray& ray, const Hit& hit, Rng& rng) const {
  const Vec3& n = hit.normal;
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : scene_.lights) {
    const auto sample = sample_light(light, hit.position, rng);
    const double cosine = sample ? sample->to_light.dot(n) : 0.0;
    if (cosine <= 0.0) continue;
    sum += more_than_similar(cosine, ray.direction, sample->to_light, n) * sample->irradiance *
           cosine *
           transmittance(scene_, caster_, hit.position, sample->to_light, sample->distance);
  }
  if (dark_surroundings_) return sum;
  const double u = rng.uniform();
  const Vec3 w = Frame(n).to_world(sample_cosine_hemisphere(u, rng.uniform()));
  return sum + pi * more_than_similar(w.dot(n), ray.direction, w, n) *
                   outside_({{hit.position, w}, 0, false, false}, rng);
}

// Difference of both half-spaces' reflection, 1/sr.
Spectrum Gather::more_than_similar(double cosine, const Vec3& view, const Vec3& to_light,
                                   const Vec3& normal) const {
  const double mu = -view.dot(normal);
  if (mu <= 0.0 || cosine <= 0.0) return Spectrum::Zero();  // through a crack of the mesh
  const Vec3 arriving = to_light - cosine * normal;
  const Vec3 leaving = view + mu * normal;
  const double both = arriving.norm() * leaving.norm();
  const double cos_phi = both > 0.0 ? std::clamp(arriving.dot(leaving) / both, -1.0, 1.0) : 1.0;
  return per_channel(scene_.channels, [&](int c) {
    const Reflections& r = reflections_[static_cast<std::size_t>(c)];
    return r.own.multiple(mu, cosine, cos_phi) - r.similar.multiple(mu, cosine, cos_phi);
  });
}

Spectrum Gather::lights(const Vec3& position, const Vec3& view, const Optics& optics,
                        Rng& rng) const {
  Spectrum sum = Spectrum::Zero();
  for (const Light& light : scene_.lights) {
    const auto sample = sample_light(light, position, rng);
    if (!sample) continue;
    // Through the object itself in this medium, then through whatever lies outside.
    const auto surface = way_out({position, sample->to_light});
    const double inside = surface ? std::min(surface->t, sample->distance) : 0.0;
    Spectrum passed = (-optics.sigma_t * inside).exp();
    if (inside < sample->distance)
      passed *= transmittance(scene_, caster_, surface ? surface->position : position,
                              sample->to_light, sample->distance - inside);
    const double cosine = sample->to_light.dot(view);
    for (int c = 0; c < 3; ++c)
      sum[c] += henyey_greenstein(cosine, optics.media[static_cast<std::size_t>(c)].g) *
                sample->irradiance[c] * passed[c];
  }
  return sum;
}

// Everything else that shines into the object, met by going where the phase function of the first
// channel leads.
Spectrum Gather::surroundings(const Vec3& position, const Vec3& view, const Optics& optics,
                              Rng& rng) const {
  const double u = rng.uniform();
  const Ray ray{position, sample_henyey_greenstein(view, optics.media[0].g, u, rng.uniform())};
  const auto hit = way_out(ray);
  Spectrum weight = (-optics.sigma_t * (hit ? hit->t : 0.0)).exp();
  if (weight.maxCoeff() < invisible) return Spectrum::Zero();
  const double cosine = ray.direction.dot(view);
  for (int c = 1; c < 3; ++c)
    weight[c] *= henyey_greenstein(cosine, optics.media[static_cast<std::size_t>(c)].g) /
                 henyey_greenstein(cosine, optics.media[0].g);
  return weight * outside_({{hit ? hit->position : position, ray.direction}, 0, false, true}, rng);
}

}  // namespace knotlight
