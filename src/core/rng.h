// Random streams keyed by (seed, purpose, index), never by thread: photon 17 draws the same numbers
// whichever thread traces it, so results have the same bits for any thread count.
#pragma once

#include <cstdint>

namespace knotlight {

// What a stream is for. Distinct purposes draw independent numbers under one seed.
enum class Stream : std::uint64_t {
  photons = 1,
  pixels,
  boundary_knots,
  check_points,
  volume_points,
  check_depths,
  low_discrepancy,
  surface_events,
  irradiance_points,
  irradiance_rays,
  tests,
  random_projection,
  reference,
  reference_lamps,
  surroundings,
  volume_emission,
  layers,
};

// Permuted congruential generator PCG32 (XSH-RR), O'Neill 2014 [O14]; period 2^64.
class Rng {
 public:
  Rng(std::uint64_t seed, Stream purpose, std::uint64_t index);

  std::uint32_t next_u32();
  // Uniform in [0, 1) with 53 random bits.
  double uniform();

 private:
  std::uint64_t state_;
  std::uint64_t increment_;
};

}  // namespace knotlight
