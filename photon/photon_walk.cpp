#include "photon/photon_walk.h"

#include <limits>

#include "core/phase_function.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

// A photon that has survived this many events is played for double or nothing: unbiased, and no
// path is endless. So rare (it takes thousands of mean free paths without absorption) that the
// doubled power does not show in the variance.
constexpr std::size_t events_between_roulettes = 1'000'000;

}  // namespace

// A photon under way.
struct PhotonWalk::Flight : LightRay {
  double power = 0.0;
  bool alive = true;
  std::uint32_t order = 0;  // interactions since it entered
  bool followed = false;    // past its first interaction ever
  bool straight = true;     // nothing but index-matched media since the light, or the surroundings
  std::size_t events = 0;
  Vec3 normal = Vec3::Zero();  // outward, of the surface that it has just entered or met
  std::uint32_t surface = 0;   // the triangle
  double depth = std::numeric_limits<double>::infinity();  // VolumePhoton::depth
};

PhotonWalk::PhotonWalk(const Scene& scene, const RayCaster& caster, int channel,
                       const Options& options)
    : passage_(scene, caster, channel), options_(options) {}

void PhotonWalk::run(const EmittedPhoton& start, Rng& rng, WalkRecord& record) const {
  run(passage_.start(start.origin, start.direction), start.power, rng, record);
}

void PhotonWalk::run(const LightRay& start, double power, Rng& rng, WalkRecord& record) const {
  Flight flight{start, power};
  follow(flight, rng, record);
}

void PhotonWalk::run_emitted(const EmittedPhoton& start, std::uint32_t object, Rng& rng,
                             WalkRecord& record) const {
  Flight flight{{start.origin, start.direction, true, false, object}, start.power};
  flight.order = 1;
  flight.followed = true;
  flight.straight = false;
  follow(flight, rng, record);
}

void PhotonWalk::follow(Flight& flight, Rng& rng, WalkRecord& record) const {
  if (flight.inside) {
    record.tally[flight.object].incident += flight.power;
    record.tally[flight.object].photons += 1;
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

// `tally`: of the diffuse object.
void PhotonWalk::meet_diffuse(Flight& flight, const Hit& hit, Rng& rng, PowerTally& tally) const {
  tally.incident += flight.power;
  tally.photons += 1;
  const double reflectance = passage_.reflectance(hit);
  if (flight.straight && !flight.inside) {
    tally.unfollowed += reflectance * flight.power;
    tally.absorbed += (1.0 - reflectance) * flight.power;
    flight.alive = false;
    return;
  }
  if (reflectance == 0.0 || rng.uniform() >= reflectance) {
    tally.absorbed += flight.power;
    flight.alive = false;
    return;
  }
  tally.reflected += flight.power;
  const double u = rng.uniform();
  const double v = rng.uniform();
  static_cast<LightRay&>(flight) = reflected_diffusely(flight, hit, u, v);
  flight.straight = false;
  flight.normal = Vec3::Zero();  // not a surface of the object it may be in
}

void PhotonWalk::walk_outside(Flight& flight, Rng& rng, WalkRecord& record) const {
  const auto hit = passage_.next_outside(flight);
  if (!hit) {
    flight.alive = false;
    return;
  }
  const Passage::Item& item = passage_.item(hit->object);
  PowerTally& tally = record.tally[hit->object];
  if (!item.translucent) {
    meet_diffuse(flight, *hit, rng, tally);
    return;
  }
  tally.incident += flight.power;
  tally.photons += 1;
  const double cosine = flight.direction.dot(hit->normal);
  if (cosine >= 0.0) {  // its front was missed
    tally.lost += flight.power;
    flight.alive = false;
    return;
  }
  const Crossing crossing = cross_surface(flight.direction, hit->normal, item.ior, item.alpha, rng);
  flight.position = hit->position;
  flight.direction = crossing.direction;
  flight.object = hit->object;
  flight.on_surface = true;
  flight.normal = hit->normal;
  flight.surface = hit->primitive;
  flight.straight = flight.straight && item.ior == 1.0;
  if (crossing.through) {
    flight.inside = true;
    flight.order = 0;
  } else {
    tally.reflected += flight.power;
  }
}

void PhotonWalk::walk_inside(Flight& flight, Rng& rng, WalkRecord& record) const {
  const Passage::Item& item = passage_.item(flight.object);
  PowerTally& tally = record.tally[flight.object];
  const double distance = sample_free_flight(rng.uniform(), item.sigma_t);
  const auto hit = passage_.next_inside(flight, distance);
  if (!record.fluxes.empty()) {
    const double length = hit ? (hit->position - flight.position).dot(flight.direction) : distance;
    const FreeFlight free{flight.position, flight.direction, length, flight.power,
                          flight.object,   flight.order,     !hit};
    for (FluxSums& flux : record.fluxes) flux.add(free);
  }
  if (!hit) {
    flight.position += distance * flight.direction;
    flight.depth = flight.on_surface && !flight.normal.isZero()
                       ? -distance * flight.direction.dot(flight.normal)
                       : std::numeric_limits<double>::infinity();
    flight.on_surface = false;
    interact(flight, rng, record);
    return;
  }
  if (hit->object != flight.object) {  // an opaque object inside the medium
    tally.escaped += flight.power;
    if (flight.order == 0) tally.escaped_unscattered += flight.power;
    meet_diffuse(flight, *hit, rng, record.tally[hit->object]);
    if (flight.alive) {
      tally.incident += flight.power;
      tally.photons += 1;
    }
    return;
  }
  const double cosine = flight.direction.dot(hit->normal);
  if (cosine <= 0.0) {  // the way out was missed
    tally.lost += flight.power;
    flight.alive = false;
    return;
  }
  const Crossing crossing =
      cross_surface(flight.direction, hit->normal, 1.0 / item.ior, item.alpha, rng);
  flight.position = hit->position;
  flight.direction = crossing.direction;
  flight.on_surface = true;
  flight.normal = hit->normal;
  flight.surface = hit->primitive;
  flight.straight = flight.straight && item.ior == 1.0;
  if (crossing.through) {
    tally.escaped += flight.power;
    if (flight.order == 0) tally.escaped_unscattered += flight.power;
    flight.inside = false;
  }
}

void PhotonWalk::interact(Flight& flight, Rng& rng, WalkRecord& record) const {
  const Passage::Item& item = passage_.item(flight.object);
  PowerTally& tally = record.tally[flight.object];
  if (!passage_.within_bounds(flight.position, flight.object)) {  // the way out was missed
    tally.lost += flight.power;
    flight.alive = false;
    return;
  }
  flight.order += 1;
  tally.interactions += flight.power;
  if (options_.store && (flight.order == 1 || !options_.store_first_only) &&
      (flight.followed || !options_.store_returned_only))
    record.photons[flight.object].push_back({flight.position, flight.direction, flight.power,
                                             flight.order, flight.surface, flight.depth});
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
  flight.straight = false;
  if (rng.uniform() >= item.albedo) {
    tally.absorbed += flight.power;
    flight.alive = false;
    return;
  }
  const double u = rng.uniform();
  const double v = rng.uniform();
  flight.direction = item.g == 0.0 ? sample_sphere(u, v)
                                   : sample_henyey_greenstein(flight.direction, item.g, u, v);
}

}  // namespace knotlight
