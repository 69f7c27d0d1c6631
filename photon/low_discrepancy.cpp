#include "photon/low_discrepancy.h"

#include <cassert>
#include <cmath>

#include "core/rng.h"

namespace knotlight {

LowDiscrepancy::LowDiscrepancy(int dimensions, std::uint64_t seed, std::uint64_t key) {
  assert(dimensions >= 1 && dimensions <= max_dimensions);
  long double phi = 2.0L;
  constexpr int iterations = 64;  // each gains at least a bit; a long double has 64
  for (int i = 0; i < iterations; ++i) phi = std::pow(1.0L + phi, 1.0L / (dimensions + 1));
  Rng rng(seed, Stream::low_discrepancy, key);
  long double alpha = 1.0L;
  for (int j = 0; j < dimensions; ++j) {
    alpha /= phi;
    alpha_[static_cast<std::size_t>(j)] = static_cast<std::uint64_t>(std::ldexp(alpha, 64));
    const std::uint64_t high = rng.next_u32();
    shift_[static_cast<std::size_t>(j)] = high << 32 | rng.next_u32();
  }
}

double LowDiscrepancy::operator()(std::uint64_t i, int dimension) const {
  const auto j = static_cast<std::size_t>(dimension);
  return std::ldexp(static_cast<double>((shift_[j] + i * alpha_[j]) >> 11), -53);
}

}  // namespace knotlight
