#include "reference/path_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/fresnel.h"
#include "core/microfacet.h"
#include "core/not_finite.h"
#include "core/phase_function.h"
#include "core/sampling.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Paths below this part of their full weight are played for: those that survive get this weight.
constexpr double roulette_weight = 0.25;
// Branches (what passes a medium unscattered, mirror images) below this part of a pixel likewise.
constexpr double branch_weight = 0.02;
// Branchings of one path; beyond, it takes one way by roulette.
constexpr int most_splits = 4;
// A path that has survived this many events is played for double or nothing: unbiased, and none is
// endless, not even where nothing absorbs. So rare that the doubled weight does not show.
constexpr std::size_t events_between_roulettes = 1'000'000;

// Balance heuristic [VG95]: of two ways of finding the same light, the weight of the one that has
// density p. With no other way, all of it.
double share_of(double p, double other) {
  return other > 0.0 ? p / (p + other) : 1.0;
}

}  // namespace

template <int C>
Channels<C> PathVertex<C>::value(const Vec3& w) const {
  if (medium == nullptr) return Channels<C>::Constant(std::max(0.0, normal.dot(w)) / pi);
  const double mu = std::clamp(arriving.dot(w), -1.0, 1.0);
  if (medium->same_phase) return Channels<C>::Constant(henyey_greenstein(mu, medium->g[0]));
  return medium->g.unaryExpr([mu](double g) { return henyey_greenstein(mu, g); });
}

template <int C>
void Path<C>::normalise() {
  const double mean = density.mean();
  weight /= mean;
  density /= mean;
  reach *= mean;
}

template <int C>
PathWalker<C>::PathWalker(const Scene& scene, const RayCaster& caster)
    : scene_(scene), surfaces_(scene, caster), lights_(scene) {
  for (const Object& object : scene.objects) {
    const TranslucentMaterial* material = object.translucent();
    optics_.push_back(material != nullptr ? Optics<C>(*material) : Optics<C>());
    refracting_.push_back(material != nullptr && material->ior != 1.0 && material->alpha() == 0.0
                              ? std::make_unique<RefractingSurface>(object.shape, material->ior)
                              : nullptr);
    const Bounds box = bounds(object.shape);
    const auto may_hold = [&](const Vec3& lo, const Vec3& hi) {
      return (lo.array() <= box.hi.array()).all() && (hi.array() >= box.lo.array()).all();
    };
    for (const auto& light : lights_.points)
      optics_.back().holds_lights |= may_hold(light.position, light.position);
    for (const auto& light : lights_.areas) {
      const Vec3 reach = light.light->u.cwiseAbs() + light.light->v.cwiseAbs();
      optics_.back().holds_lights |=
          may_hold(light.light->center - reach, light.light->center + reach);
    }
  }
  for (auto& light : lights_.points) {
    light.medium = surfaces_.medium_around(light.position);
    if (light.medium) optics_[*light.medium].holds_points = true;
  }
}

template <int C>
Spectrum PathWalker<C>::radiance(const Ray& eye, Rng& rng) const {
  Sample sample{rng, Channels<C>::Zero(), {}, 0, {}};
  Path<C> path;
  path.ray.position = eye.origin;
  path.ray.direction = eye.direction;
  if constexpr (C > 1) path.hero = std::min(C - 1, static_cast<int>(C * rng.uniform()));
  while (step(path, sample)) {
  }
  while (sample.waiting > 0) {
    path = sample.pending[--sample.waiting];
    while (step(path, sample)) {
    }
  }
  if constexpr (C == 1)
    return Spectrum::Constant(sample.found[0]);
  else
    return sample.found;
}

template <int C>
bool PathWalker<C>::step(Path<C>& path, Sample& sample) const {
  if (++path.events % events_between_roulettes == 0) {
    if (sample.rng.uniform() < 0.5) return false;
    path.weight *= 2.0;
  }
  if (!path.ray.inside) return cross_free_space(path, sample);
  if (!path.scattered && path.splits < most_splits && sample.room())
    return first_crossing(path, sample);
  return cross_medium(path, sample);
}

template <int C>
bool PathWalker<C>::survives(Path<C>& path, double least, Rng& rng) {
  const double probability = path.strength() / (least * path.full_weight);
  if (probability >= 1.0) return true;
  if (!(rng.uniform() < probability)) return false;
  path.weight /= probability;
  return true;
}

template <int C>
bool PathWalker<C>::cross_free_space(Path<C>& path, Sample& sample) const {
  const auto hit = surfaces_.next(path.ray);
  const double distance = hit ? hit->t : infinity;
  // A light that lies against a surface is in front of it.
  const double lit_distance = distance + surfaces_.touching_distance();
  if (path.scattered) {
    see_area_lights(path, lit_distance, sample);
  } else if (const auto body =
                 lights_.nearest_body(path.ray.position, path.ray.direction, lit_distance)) {
    sample.found += path.weight * body->radiance;
    return false;
  }
  if (hit) return meet_surface(path, *hit, sample);
  see_sky(path, sample);
  return false;
}

// A medium on the way from the eye: what passes it and what is scattered in it are two branches,
// each with its exact weight. Light emitted on the way in closed form.
template <int C>
bool PathWalker<C>::first_crossing(Path<C>& path, Sample& sample) const {
  const Optics<C>& medium = optics_[path.ray.medium];
  const auto hit = surfaces_.next(path.ray);
  if (!hit) return false;  // rounding has put the path outside
  const auto body = medium.holds_lights
                        ? lights_.nearest_body(path.ray.position, path.ray.direction, hit->t)
                        : std::nullopt;
  const double length = body ? body->distance : hit->t;
  const Channels<C> passing = (-medium.sigma_t * length).exp();
  const Channels<C> stopped =
      (medium.sigma_t * length).unaryExpr([](double x) { return -std::expm1(-x); });
  light_along(path, length, sample);
  for (int c = 0; c < C; ++c)
    if (medium.radiated[c] > 0.0) {
      const double optical_length =
          medium.sigma_t[c] > 0.0 ? stopped[c] / medium.sigma_t[c] : length;
      sample.found[c] += path.weight[c] * medium.radiated[c] * optical_length;
    }
  path.splits += 1;

  Path<C> passed = path;
  passed.weight *= passing;
  if (body)
    sample.found += passed.weight * body->radiance;
  else if (survives(passed, branch_weight, sample.rng) && meet_surface(passed, *hit, sample))
    sample.pending[sample.waiting++] = passed;

  if (!(stopped[path.hero] > 0.0)) return false;
  const double s =
      -std::log1p(-sample.rng.uniform() * stopped[path.hero]) / medium.sigma_t[path.hero];
  const Channels<C> left = (-medium.sigma_t * s).exp();
  path.weight *= medium.sigma_s * left;
  for (int c = 0; c < C; ++c)
    path.density[c] *= stopped[c] > 0.0 ? medium.sigma_t[c] * left[c] / stopped[c] : 0.0;
  path.normalise();
  path.ray.position += s * path.ray.direction;
  path.ray.surface.reset();
  path.full_weight = path.strength();
  return scatter_in_medium(path, sample);
}

// A free flight [V09 6.18], ended by a collision or by a surface.
template <int C>
bool PathWalker<C>::cross_medium(Path<C>& path, Sample& sample) const {
  const Optics<C>& medium = optics_[path.ray.medium];
  const double sigma_hero = medium.sigma_t[path.hero];
  const double flight =
      sigma_hero > 0.0 ? sample_free_flight(sample.rng.uniform(), sigma_hero) : infinity;
  const auto hit = surfaces_.next(path.ray, flight);
  const double length = hit ? hit->t : flight;
  if (!hit &&
      !surfaces_.plausible(path.ray.position + length * path.ray.direction, path.ray.medium))
    return false;
  if (medium.holds_points)
    if (const auto end = surfaces_.next(path.ray)) light_along(path, end->t, sample);
  if (medium.holds_lights) {
    if (path.scattered) {
      see_area_lights(path, length, sample);
    } else if (const auto body =
                   lights_.nearest_body(path.ray.position, path.ray.direction, length)) {
      const Channels<C> left = (-medium.sigma_t * body->distance).exp();
      sample.found += path.weight * left / (path.density * left).mean() * body->radiance;
      return false;
    }
  }
  if (medium.emits) {
    // Expectation of the length flown = int exp(-sigma_t s) ds. Where channels differ, by one point
    // of the length, weighed by how likely all channels together were to get there.
    if (medium.same_extinction) {
      sample.found += path.weight * medium.radiated * length;
    } else {
      const Channels<C> left = (-medium.sigma_t * (length * sample.rng.uniform())).exp();
      sample.found += path.weight * left / (path.density * left).mean() * medium.radiated * length;
    }
  }
  if (medium.same_extinction) {
    if (!hit) path.weight *= medium.sigma_s / medium.sigma_t;
    if (hit && lights_.found_twice) path.reach *= std::exp(-medium.sigma_t[0] * length);
  } else {
    const Channels<C> left = (-medium.sigma_t * length).exp();
    path.weight *= hit ? left : Channels<C>(medium.sigma_s * left);
    path.density *= hit ? left : Channels<C>(medium.sigma_t * left);
    path.normalise();
  }
  if (hit) return meet_surface(path, *hit, sample);
  path.ray.position += length * path.ray.direction;
  path.ray.surface.reset();
  return scatter_in_medium(path, sample);
}

template <int C>
bool PathWalker<C>::meet_surface(Path<C>& path, const Hit& hit, Sample& sample) const {
  if (scene_.objects[hit.object].translucent() == nullptr)
    return scatter_on_surface(path, hit, sample);
  const double facing = hit.normal.dot(path.ray.direction);
  const bool leaving = path.ray.inside;
  if (leaving ? facing <= 0.0 : facing >= 0.0) return false;  // rounding: its other side was missed
  path.ray.position = hit.position;
  path.ray.surface = hit.object;
  const double ior = optics_[hit.object].ior;
  if (ior != 1.0) return meet_dielectric(path, hit, leaving ? 1.0 / ior : ior, sample);
  path.ray.inside = !leaving;
  path.ray.medium = hit.object;
  return true;
}

// A rough surface is a walk over its facets. A smooth one: mirrored with the Fresnel reflectance R,
// else refracted. What is conserved along the refracted way is radiance over n^2 [PBRT 8.2.3].
// ior_ahead: index of the far side over that of the near one.
template <int C>
bool PathWalker<C>::meet_dielectric(Path<C>& path, const Hit& hit, double ior_ahead,
                                    Sample& sample) const {
  const auto transmit = [&](const Vec3& direction) {
    path.weight /= ior_ahead * ior_ahead;
    path.index2 *= ior_ahead * ior_ahead;
    path.ray.direction = direction;
    path.ray.inside = !path.ray.inside;
    path.ray.medium = hit.object;
  };
  const double alpha = optics_[hit.object].alpha;
  if (alpha > 0.0) {
    const SurfaceEvent event =
        cross_rough_surface(path.ray.direction, hit.normal, ior_ahead, alpha, sample.rng);
    path.way = Way::unconnected;
    if (event.transmitted)
      transmit(event.direction);
    else
      path.ray.direction = event.direction;
    return true;
  }
  const double R = fresnel_reflectance(std::abs(hit.normal.dot(path.ray.direction)), ior_ahead);
  const auto refracted = refract(path.ray.direction, hit.normal, ior_ahead);
  const Vec3 mirrored = reflect(path.ray.direction, hit.normal);
  bool mirror = !refracted;
  if (refracted && !path.scattered && path.splits < most_splits && sample.room()) {
    path.splits += 1;
    Path<C> image = path;
    image.way = Way::unconnected;
    image.ray.direction = mirrored;
    image.weight *= R;
    if (survives(image, branch_weight, sample.rng)) sample.pending[sample.waiting++] = image;
    path.weight *= 1.0 - R;
  } else if (refracted) {
    mirror = sample.rng.uniform() < R;
  }
  if (mirror) {
    path.way = Way::unconnected;
    path.ray.direction = mirrored;
    return true;
  }
  if (path.ray.inside && path.way == Way::straight && refracting_[hit.object]->quick()) {
    path.way = Way::refracted;
    path.reach *= 1.0 - R;
    path.exit = {hit.position,
                 (hit.position - path.vertex).norm(),
                 refracted->dot(hit.normal),
                 path.ray.direction.dot(hit.normal),
                 optics_[hit.object].ior,
                 refracting_[hit.object]->curvature()};
  } else {
    path.way = Way::unconnected;
  }
  transmit(*refracted);
  return true;
}

template <int C>
bool PathWalker<C>::scatter_in_medium(Path<C>& path, Sample& sample) const {
  const Optics<C>& medium = optics_[path.ray.medium];
  if (!(path.strength() > 0.0)) return false;
  path.scattered = true;
  const PathVertex<C> vertex{&medium, path.ray.direction, Vec3::Zero()};
  next_event(path, vertex, sample);
  if (!survives(path, roulette_weight, sample.rng)) return false;
  const double u = sample.rng.uniform();
  const double v = sample.rng.uniform();
  path.ray.direction = sample_henyey_greenstein(path.ray.direction, medium.g[path.hero], u, v);
  path.way = Way::straight;
  path.vertex = path.ray.position;
  path.reach = 1.0;
  if (!medium.same_phase) {
    const Channels<C> value = vertex.value(path.ray.direction);
    path.weight *= value;
    path.density *= value;
    path.normalise();
  } else if (lights_.found_twice) {
    path.reach = vertex.value(path.ray.direction)[0];
  }
  return true;
}

template <int C>
bool PathWalker<C>::scatter_on_surface(Path<C>& path, const Hit& hit, Sample& sample) const {
  path.weight *= channels<C>(reflectance_at(scene_.objects[hit.object], hit));
  if (!(path.strength() > 0.0)) return false;
  if (!path.scattered) path.full_weight = path.strength();
  path.scattered = true;
  path.ray.position = hit.position;
  path.ray.surface = hit.object;
  const bool front = hit.normal.dot(path.ray.direction) < 0.0;
  const PathVertex<C> vertex{nullptr, path.ray.direction, front ? hit.normal : Vec3(-hit.normal)};
  next_event(path, vertex, sample);
  if (!survives(path, roulette_weight, sample.rng)) return false;
  const double u = sample.rng.uniform();
  const double v = sample.rng.uniform();
  path.ray.direction = Frame(vertex.normal).to_world(sample_cosine_hemisphere(u, v));
  path.way = Way::straight;
  path.vertex = path.ray.position;
  path.reach = vertex.value(path.ray.direction)[0];
  return true;
}

// Area lights do not stand in the way of light: a flight passes them. Each would also have been
// found from the vertex; the balance heuristic weighs the two ways.
template <int C>
void PathWalker<C>::see_area_lights(const Path<C>& path, double length, Sample& sample) const {
  for (const auto& light : lights_.areas) {
    if (!light.shines_against(path.ray.direction)) continue;
    const auto t = light.met(path.ray.position, path.ray.direction);
    if (!t || *t >= length) continue;
    Channels<C> weight = path.weight;
    double reach = path.reach;
    if (path.ray.inside) {
      const Channels<C> left = (-optics_[path.ray.medium].sigma_t * *t).exp();
      const double mean = (path.density * left).mean();
      weight *= left / mean;
      reach *= mean;
    }
    weight *= share_of(reach, area_density(path, light, *t));
    sample.found += weight * light.radiance;
  }
}

// From vertices the light of a lamp in the same medium would have infinite variance, since its
// irradiance grows as 1/r^2. Along a whole flight the vertex is drawn so that the lamp sees equal
// angles alike [KF12]: with D the distance of the lamp from the line, 1/r^2 over that density is
// angle / D.
template <int C>
void PathWalker<C>::light_along(const Path<C>& path, double length, Sample& sample) const {
  const Optics<C>& medium = optics_[path.ray.medium];
  if (!medium.holds_points) return;
  const PathVertex<C> vertex{&medium, path.ray.direction, Vec3::Zero()};
  for (const auto& light : lights_.points) {
    if (!light.medium || *light.medium != path.ray.medium) continue;
    const Vec3 to_light = light.position - path.ray.position;
    const double nearest = to_light.dot(path.ray.direction);
    const double D = (to_light - nearest * path.ray.direction).norm();
    if (!(D > 0.0)) continue;
    const double first = std::atan2(-nearest, D);
    const double angle = std::atan2(length - nearest, D) - first;
    const double t =
        std::clamp(nearest + D * std::tan(first + sample.rng.uniform() * angle), 0.0, length);
    PathRay ray = path.ray;
    ray.position += t * path.ray.direction;
    ray.surface.reset();
    const Vec3 from_vertex = light.position - ray.position;
    const double distance = from_vertex.norm();
    ray.direction = from_vertex / distance;
    const auto optical_depth = depth(ray, distance);
    if (!optical_depth) continue;
    sample.found += path.weight * medium.sigma_s * (-medium.sigma_t * t - *optical_depth).exp() *
                    vertex.value(ray.direction) * light.intensity * (angle / D);
  }
}

template <int C>
void PathWalker<C>::see_sky(const Path<C>& path, Sample& sample) const {
  const Vec3& w = path.ray.direction;
  for (const auto& sky : lights_.skies) {
    const double share =
        sky.map != nullptr ? share_of(path.reach, sky_density(path, *sky.map)) : 1.0;
    sample.found += share * path.weight * sky.seen(w);
  }
}

template <int C>
double PathWalker<C>::area_density(const Path<C>& path, const typename LightTable<C>::Area& light,
                                   double distance) const {
  switch (path.way) {
    case Way::straight: {
      const Vec3 there = path.ray.position + distance * path.ray.direction;
      return light.pdf(path.ray.direction, (there - path.vertex).norm());
    }
    case Way::refracted: {
      const Vec3 there = path.ray.position + distance * path.ray.direction;
      return light.pdf(path.ray.direction, 1.0) *
             path.exit.per_solid_angle((there - path.exit.crossing).norm());
    }
    case Way::unconnected:
      break;
  }
  return 0.0;
}

template <int C>
double PathWalker<C>::sky_density(const Path<C>& path, const EnvironmentMap& map) const {
  switch (path.way) {
    case Way::straight:
      return map.pdf(path.ray.direction);
    case Way::refracted:
      return map.pdf(path.ray.direction) * path.exit.per_solid_angle(infinity);
    case Way::unconnected:
      break;
  }
  return 0.0;
}

template <int C>
void PathWalker<C>::next_event(const Path<C>& path, const PathVertex<C>& vertex,
                               Sample& sample) const {
  PathRay ray = path.ray;
  if (ray.inside && optics_[ray.medium].ior != 1.0) {
    if (refracting_[ray.medium] != nullptr) refracted_next_event(path, vertex, sample);
    // No straight way leads to a light outside.
    if (!optics_[ray.medium].holds_lights) return;
  }
  // Radiance from w, found with the density `pdf` per solid angle (0: in this way alone).
  const auto add = [&](const Vec3& w, double distance, const Channels<C>& radiance, double pdf) {
    const Channels<C> value = vertex.value(w);
    if (!(value.maxCoeff() > 0.0)) return;
    ray.direction = w;
    const auto optical_depth = depth(ray, distance);
    if (!optical_depth) return;
    const Channels<C> left = (-*optical_depth).exp();
    const double both = pdf > 0.0 ? pdf + (path.density * value * left).mean() : 1.0;
    sample.found += path.weight * value * left * radiance / both;
  };
  for (const auto& light : lights_.points) {
    // Done by light_along.
    if (vertex.medium != nullptr && light.medium && *light.medium == ray.medium) continue;
    const Vec3 to_light = light.position - ray.position;
    const double distance = to_light.norm();
    add(to_light / distance, distance, light.intensity / (distance * distance), 0.0);
  }
  for (const auto& light : lights_.directionals)
    add(light.towards, infinity, light.irradiance, 0.0);
  for (const auto& light : lights_.areas) {
    const double s = 2.0 * sample.rng.uniform() - 1.0;
    const double t = 2.0 * sample.rng.uniform() - 1.0;
    const Vec3 to_light =
        light.light->center + s * light.light->u + t * light.light->v - ray.position;
    const double distance = to_light.norm();
    const Vec3 w = to_light / distance;
    if (light.shines_against(w)) add(w, distance, light.radiance, light.pdf(w, distance));
  }
  for (const auto& sky : lights_.skies) {
    if (sky.map == nullptr) continue;
    const double u = sample.rng.uniform();
    const double v = sample.rng.uniform();
    const EnvironmentMap::Sample drawn = sky.map->sample(u, v);
    add(drawn.direction, infinity, sky.seen(drawn.direction), drawn.pdf);
  }
}

template <int C>
void PathWalker<C>::refracted_next_event(const Path<C>& path, const PathVertex<C>& vertex,
                                         Sample& sample) const {
  const std::uint32_t object = path.ray.medium;
  const double index2 = optics_[object].ior * optics_[object].ior;
  // emission(way): intensity of a light at a place, irradiance across the beam of one at infinity;
  // of an extended light that of its sample, and the density of that per area across the way at a
  // place, per solid angle at infinity (0: not extended).
  const auto add = [&](const LightPlace& place, const auto& emission, bool mirrored) {
    sample.ways.clear();
    refracting_[object]->find(path.ray.position, place, sample.ways);
    if (mirrored)
      refracting_[object]->find_mirrored(
          path.ray.position, place, optics_[object].sigma_t.minCoeff(), sample.rng, sample.ways);
    for (const RefractedWay& way : sample.ways) {
      const std::pair<Channels<C>, double> emitted = emission(way);
      const Channels<C> value = vertex.value(way.start);
      if (!((value * emitted.first).maxCoeff() > 0.0) || !surfaces_.open(path.ray, way)) continue;
      const PathRay ray{way.crossing, way.outside, false, object, object};
      const auto outer_depth = depth(ray, way.outer_length);
      if (!outer_depth) continue;
      const Channels<C> left = (-optics_[object].sigma_t * way.length - *outer_depth).exp();
      const double by_event = emitted.second * index2 / way.gain;
      const double by_chance = (path.density * value * left).mean() * way.transmitted;
      sample.found += path.weight * value * left * emitted.first *
                      (way.transmitted * way.gain *
                       (emitted.second > 0.0 ? share_of(by_event, by_chance) : 1.0));
    }
  };
  const auto always = [](const Channels<C>& emitted) {
    return [&emitted](const RefractedWay&) { return std::pair(emitted, 0.0); };
  };
  for (const auto& light : lights_.points)
    add({light.position, false}, always(light.intensity), true);
  for (const auto& light : lights_.directionals)
    add({light.towards, true}, always(light.irradiance), true);
  // What can be found by chance too is left to chance where a search costs more than it saves, and
  // where it has been mirrored.
  if (!refracting_[object]->quick()) return;
  for (const auto& light : lights_.areas) {
    const double s = 2.0 * sample.rng.uniform() - 1.0;
    const double t = 2.0 * sample.rng.uniform() - 1.0;
    const Vec3 place = light.light->center + s * light.light->u + t * light.light->v;
    const auto emission = [&light](const RefractedWay& way) {
      const double across = std::max(0.0, -light.normal.dot(way.outside)) * light.area;
      return std::pair(Channels<C>(light.radiance * across), across > 0.0 ? 1.0 / across : 0.0);
    };
    add({place, false}, emission, false);
  }
  for (const auto& sky : lights_.skies) {
    if (sky.map == nullptr) continue;
    const double u = sample.rng.uniform();
    const double v = sample.rng.uniform();
    const EnvironmentMap::Sample drawn = sky.map->sample(u, v);
    const auto emission = [&](const RefractedWay&) {
      return std::pair(Channels<C>(sky.seen(drawn.direction) / drawn.pdf), drawn.pdf);
    };
    add({drawn.direction, true}, emission, false);
  }
}

template <int C>
std::optional<Channels<C>> PathWalker<C>::depth(PathRay ray, double distance) const {
  Channels<C> sum = Channels<C>::Zero();
  // A light that lies against a surface is in front of it.
  const double slack = surfaces_.touching_distance();
  while (true) {
    const auto hit = surfaces_.next(ray, distance - slack);
    if (ray.inside) {
      const double length = hit ? hit->t : distance;
      if (length == infinity) return std::nullopt;  // rounding: the way out was missed
      sum += optics_[ray.medium].sigma_t * length;
    }
    if (!hit) return sum;
    const Optics<C>& medium = optics_[hit->object];
    if (scene_.objects[hit->object].translucent() == nullptr || medium.ior != 1.0)
      return std::nullopt;
    ray.position = hit->position;
    ray.surface = hit->object;
    ray.inside = !ray.inside;
    ray.medium = hit->object;
    distance -= hit->t;
  }
}

template class PathWalker<1>;
template class PathWalker<3>;

}  // namespace knotlight
