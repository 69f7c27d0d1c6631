// Points that fill the unit cube more evenly than random ones: sums over n of them err by about 1/n
// for smooth integrands, where random points err by n^-1/2.
#pragma once

#include <array>
#include <cstdint>

namespace knotlight {

// The additive recurrence x_i = frac(shift + i alpha), alpha_j = phi^-j, where phi solves
// phi^(d+1) = phi + 1: the golden ratio for d = 1, its generalisation for more dimensions [R18].
// The shift is uniform and keyed by (seed, key), so any single point is uniform, sums are unbiased,
// and two keys give independent estimates.
class LowDiscrepancy {
 public:
  static constexpr int max_dimensions = 8;

  // 1 <= dimensions <= max_dimensions.
  LowDiscrepancy(int dimensions, std::uint64_t seed, std::uint64_t key);

  // Coordinate `dimension` of point i, in [0, 1). Exact to 2^-53 for any i: the recurrence runs in
  // 64-bit integers.
  double operator()(std::uint64_t i, int dimension) const;

 private:
  std::array<std::uint64_t, max_dimensions> alpha_{};  // in units of 2^-64
  std::array<std::uint64_t, max_dimensions> shift_{};
};

}  // namespace knotlight
