// Points that fill the unit cube more evenly than random ones: sums over n of them err by about 1/n
// or less for smooth integrands, where random points err by n^-1/2.
#pragma once

#include <array>
#include <cstdint>

namespace knotlight {

// Sobol's sequence with the direction numbers of Joe and Kuo [JK08], each coordinate scrambled by
// Owen's nested permutation of binary digits [O97], hashed as in [B20] and keyed by (seed, key).
// Any single point is uniform, so sums are unbiased; two keys give independent estimates; and
// whatever the integrand, the variance is at most a small multiple of that of random points. The
// first coordinates are the most evenly filled together: give them to what matters most.
class LowDiscrepancy {
 public:
  static constexpr int max_dimensions = 5;

  // 1 <= dimensions <= max_dimensions.
  LowDiscrepancy(int dimensions, std::uint64_t seed, std::uint64_t key);

  // Coordinate `dimension` of point i < 2^32, in [0, 1), to 2^-32.
  double operator()(std::uint64_t i, int dimension) const;

 private:
  std::array<std::uint32_t, max_dimensions> scramble_{};
};

}  // namespace knotlight
