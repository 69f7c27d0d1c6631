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

}  // namespace

// A photon under way.
struct PhotonWalk::Flight : LightRay {
  double power = 0.0;
  bool alive = true;
  std::uint32_t order = 0;  // interactions since it entered
  bool followed = false;    // past its first interaction ever
  std::size_t events = 0;
};

PhotonWalk::PhotonWalk(const Scene& scene, const RayCaster& caster, int channel,
                       const Options& options)
    : passage_(scene, caster, channel), options_(options) {}

void PhotonWalk::run(const EmittedPhoton& start, Rng& rng, WalkRecord& record) const {
  Flight flight{passage_.start(start.origin, start.direction), start.power};
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

void PhotonWalk::walk_outside(Flight& flight, Rng& rng, WalkRecord& record) const {
  const auto hit = passage_.next_outside(flight);
  if (!hit) {
    flight.alive = false;
    return;
  }
  const Passage::Item& item = passage_.item(hit->object);
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
  const double v = rng.uniform();
  flight.direction = item.g == 0.0 ? sample_sphere(u, v)
                                   : sample_henyey_greenstein(flight.direction, item.g, u, v);
}

}  // namespace knotlight
