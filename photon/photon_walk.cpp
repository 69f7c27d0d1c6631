#include "photon/photon_walk.h"

#include <limits>

#include "core/fresnel.h"
#include "core/phase_function.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

// A photon that has survived this many events is played for double or nothing: unbiased, and no
// path is endless. So rare (it takes thousands of mean free paths without absorption) that the
// doubled power does not show in the variance.
constexpr std::size_t events_between_roulettes = 1'000'000;

bool contains(const Bounds& b, const Vec3& p, double slack) {
  return (p.array() >= b.lo.array() - slack).all() && (p.array() <= b.hi.array() + slack).all();
}

bool overlap(const Bounds& a, const Bounds& b, double slack) {
  return (a.lo.array() <= b.hi.array() + slack).all() &&
         (b.lo.array() <= a.hi.array() + slack).all();
}

}  // namespace

// A photon under way.
struct PhotonWalk::Flight {
  Vec3 position;
  Vec3 direction;
  double power;
  bool alive = true;
  bool inside = false;
  bool on_surface = false;   // of `object`; else in free space or in its interior
  std::uint32_t object = 0;  // that it is inside of, or on the surface of
  std::uint32_t order = 0;   // interactions since it entered
  bool followed = false;     // past its first interaction ever
  std::size_t events = 0;

  Ray ray(double t_max = std::numeric_limits<double>::infinity()) const {
    return {position, direction, t_max};
  }
};

PhotonWalk::PhotonWalk(const Scene& scene, const RayCaster& caster, int channel,
                       const Options& options)
    : caster_(caster), options_(options), touch_(caster.touching_distance()) {
  for (const Object& object : scene.objects) {
    Item item{false, 0.0, 0.0, 0.0, 1.0, bounds(object.shape), {}, {}};
    if (const TranslucentMaterial* material = object.translucent()) {
      const Medium medium = material->medium(channel);
      item.translucent = true;
      item.sigma_t = medium.sigma_t();
      item.albedo = medium.albedo();
      item.g = medium.g;
      item.ior = medium.ior;
      if (!target_) target_.emplace();
      target_->extend(item.bounds.lo);
      target_->extend(item.bounds.hi);
    }
    scene_bounds_.extend(item.bounds.lo);
    scene_bounds_.extend(item.bounds.hi);
    items_.push_back(std::move(item));
  }
  for (std::size_t i = 0; i < items_.size(); ++i) {
    for (std::uint32_t j = 0; j < items_.size(); ++j) {
      if (i == j || !overlap(items_[i].bounds, items_[j].bounds, touch_)) continue;
      items_[i].touching.push_back(j);
      if (!items_[j].translucent) items_[i].touching_opaque.push_back(j);
    }
  }
}

void PhotonWalk::run(const EmittedPhoton& start, Rng& rng, WalkRecord& record) const {
  Flight flight{start.origin, start.direction, start.power};
  if (const auto around = object_around(start.origin)) {
    flight.inside = true;
    flight.object = *around;
    record.tally[*around].incident += flight.power;
    record.tally[*around].photons += 1;
  }
  while (flight.alive) {
    if (flight.inside)
      walk_inside(flight, rng, record);
    else
      walk_outside(flight, rng, record);
    if (++flight.events % events_between_roulettes == 0) {
      flight.alive = flight.alive && rng.uniform() < 0.5;
      flight.power *= 2.0;
    }
  }
}

// The translucent object that a light's photon starts in, if any.
std::optional<std::uint32_t> PhotonWalk::object_around(const Vec3& p) const {
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (items_[i].translucent && contains(items_[i].bounds, p, 0.0) && caster_.inside(p, i))
      return i;
  return std::nullopt;
}

// Where the ray through p along d meets `object` within the touching distance of p, on either side:
// what a ray that starts at p would skip.
std::optional<Hit> PhotonWalk::contact(const Vec3& p, const Vec3& d, std::uint32_t object) const {
  return caster_.nearest({p - touch_ * d, d, 2.0 * touch_}, object);
}

// The next surface in free space. Light that leaves A where B touches it meets B's surface there;
// an opaque surface that touches a translucent one shields it from outside.
std::optional<Hit> PhotonWalk::next_outside(const Flight& flight) const {
  if (flight.on_surface) {
    for (const std::uint32_t other : items_[flight.object].touching_opaque)
      if (auto hit = contact(flight.position, flight.direction, other)) return hit;
    for (const std::uint32_t other : items_[flight.object].touching) {
      auto hit = contact(flight.position, flight.direction, other);
      if (hit && flight.direction.dot(hit->normal) < 0.0) return hit;
    }
  }
  auto hit = caster_.nearest(flight.ray());
  if (hit)
    for (const std::uint32_t other : items_[hit->object].touching_opaque)
      if (auto shield = contact(hit->position, flight.direction, other)) return shield;
  return hit;
}

// What ends a free flight of the given length inside flight.object: its own surface or, before
// that, an opaque one. Nothing: the photon interacts first. Of hit, `t` is not to be used.
std::optional<Hit> PhotonWalk::next_inside(const Flight& flight, double distance) const {
  Ray ray = flight.ray(distance);
  if (!flight.on_surface) {
    // From the interior the search starts behind the photon, or it would skip a surface just ahead.
    ray.origin -= touch_ * flight.direction;
    ray.t_max += touch_;
  }
  auto hit = caster_.nearest(ray);
  if (hit && !flight.on_surface && hit->t <= touch_) {  // that surface lies behind the photon
    ray = flight.ray(distance);
    hit = caster_.nearest(ray);
  }
  if (!hit || hit->object == flight.object) return hit;

  Ray to_own = ray;
  to_own.t_max += touch_;
  const auto own = caster_.nearest(to_own, flight.object);
  const bool before_own = !own || hit->t < own->t - touch_;
  if (!items_[hit->object].translucent && before_own) return hit;
  return own && own->t < ray.t_max ? own : std::nullopt;
}

void PhotonWalk::walk_outside(Flight& flight, Rng& rng, WalkRecord& record) const {
  const auto hit = next_outside(flight);
  if (!hit) {
    flight.alive = false;
    return;
  }
  const Item& item = items_[hit->object];
  PowerTally& tally = record.tally[hit->object];
  tally.incident += flight.power;
  tally.photons += 1;
  if (!item.translucent) {
    tally.absorbed += flight.power;
    flight.alive = false;
    return;
  }
  const double cosine = flight.direction.dot(hit->normal);
  if (cosine >= 0.0) {  // its front was missed
    tally.lost += flight.power;
    flight.alive = false;
    return;
  }
  const auto refracted = refract(flight.direction, hit->normal, item.ior);
  const double u = rng.uniform();
  flight.position = hit->position;
  flight.object = hit->object;
  flight.on_surface = true;
  if (!refracted || u < fresnel_reflectance(-cosine, item.ior)) {
    tally.reflected += flight.power;
    flight.direction = reflect(flight.direction, hit->normal);
  } else {
    flight.direction = *refracted;
    flight.inside = true;
    flight.order = 0;
  }
}

void PhotonWalk::walk_inside(Flight& flight, Rng& rng, WalkRecord& record) const {
  const Item& item = items_[flight.object];
  PowerTally& tally = record.tally[flight.object];
  const double distance = sample_free_flight(rng.uniform(), item.sigma_t);
  const auto hit = next_inside(flight, distance);
  if (!hit) {
    flight.position += distance * flight.direction;
    flight.on_surface = false;
    interact(flight, rng, record);
    return;
  }
  if (hit->object != flight.object) {  // an opaque object inside the medium
    PowerTally& opaque = record.tally[hit->object];
    opaque.incident += flight.power;
    opaque.absorbed += flight.power;
    opaque.photons += 1;
    tally.escaped += flight.power;
    if (flight.order == 0) tally.escaped_unscattered += flight.power;
    flight.alive = false;
    return;
  }
  const double cosine = flight.direction.dot(hit->normal);
  if (cosine <= 0.0) {  // the way out was missed
    tally.lost += flight.power;
    flight.alive = false;
    return;
  }
  const auto refracted = refract(flight.direction, hit->normal, 1.0 / item.ior);
  const double u = rng.uniform();
  flight.position = hit->position;
  flight.on_surface = true;
  if (!refracted || u < fresnel_reflectance(cosine, 1.0 / item.ior)) {
    flight.direction = reflect(flight.direction, hit->normal);
  } else {
    tally.escaped += flight.power;
    if (flight.order == 0) tally.escaped_unscattered += flight.power;
    flight.direction = *refracted;
    flight.inside = false;
  }
}

void PhotonWalk::interact(Flight& flight, Rng& rng, WalkRecord& record) const {
  const Item& item = items_[flight.object];
  PowerTally& tally = record.tally[flight.object];
  if (!contains(item.bounds, flight.position, touch_)) {  // the way out was missed
    tally.lost += flight.power;
    flight.alive = false;
    return;
  }
  flight.order += 1;
  tally.interactions += flight.power;
  if (options_.store && (flight.order == 1 || !options_.store_first_only) &&
      (flight.followed || !options_.store_returned_only))
    record.photons[flight.object].push_back(
        {flight.position, flight.direction, flight.power, flight.order});
  if (!flight.followed && options_.follow_probability < 1.0) {
    if (rng.uniform() >= options_.follow_probability) {
      tally.unfollowed += flight.power;
      flight.alive = false;
      return;
    }
    const double raised = flight.power / options_.follow_probability;
    tally.unfollowed += flight.power - raised;
    flight.power = raised;
  }
  flight.followed = true;
  if (rng.uniform() >= item.albedo) {
    tally.absorbed += flight.power;
    flight.alive = false;
    return;
  }
  const double u = rng.uniform();
  flight.direction = sample_henyey_greenstein(flight.direction, item.g, u, rng.uniform());
}

}  // namespace knotlight
