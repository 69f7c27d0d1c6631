// Light up to its first interaction, by expected values: rays from the lights at low-discrepancy
// points, split at surfaces instead of thrown by dice, and along each ray inside a medium a few
// points that carry what is expected to interact around them, instead of one random collision.
#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "photon/volume_photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct FirstLightOptions {
  std::size_t rays = 250'000;  // emitted by the lights
  int points_per_ray = 1;      // per stay in a medium, 1 to 8
  // stratified: equal powers at depths that shift from ray to ray, as one more dimension of the
  // low-discrepancy points; unbiased for densities and integrals alike, and one point per ray is
  // then as good as eight (docs/results/expected-values.md). gauss: the Gauss rule of the depth
  // law; for integrals of smooth functions, not for densities, since all rays share their depths.
  enum class Depths { stratified, gauss } depths = Depths::stratified;
  std::uint64_t seed = 1;
  std::uint64_t replicate = 0;  // independent estimates under one seed
};

// Where a flight through a medium starts or ends.
struct FlightEnd {
  Vec3 position;
  Vec3 normal;   // outward, of the surface there; zero where a light inside the medium starts it
  double power;  // W: minus that of the light at the start, plus what is left at the end
};

struct FirstLight {
  // Per scene object, empty if not translucent: all of order 1, power = expected power that
  // interacts there first since it entered. Their sum is what PhotonWalk's first interactions
  // deliver in the mean, without light that was scattered before it entered
  // (TracerOptions::Orders::returned delivers that). Light that came by way of diffuse objects is
  // in it (surroundings_light.h).
  std::vector<std::vector<VolumePhoton>> photons;
  // Per scene object with g != 0: both ends of every flight. With them, the flux moment of the
  // light needs no derivative: the sum over photons of power w . grad v has the expected value
  // sigma_t times the sum of power v over photons, plus sigma_t times that over ends (partial
  // integration along each flight).
  std::vector<std::vector<FlightEnd>> ends;
  double emitted = 0.0;  // W, by the lights towards the sphere around the translucent objects
};

// Chords, refraction, internal and external reflection, passage through one object into another
// and lights inside objects are followed to the end: both branches at each surface while they
// matter, unbiased roulette below a thousandth of the ray's power. Same bits for any number of
// workers. Advances the stage by options.rays in all.
FirstLight trace_first_light(const Scene& scene, const RayCaster& caster, int channel,
                             const FirstLightOptions& options, const Workers& workers,
                             Stage& stage);

}  // namespace knotlight
