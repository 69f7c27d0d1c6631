#include "photon/low_discrepancy.h"

#include <cassert>
#include <cmath>
#include <initializer_list>

#include "core/rng.h"

namespace knotlight {
namespace {

using Columns = std::array<std::uint32_t, 32>;  // direction numbers, the first bit on top

// From a primitive polynomial of degree s with inner coefficients a and the initial numbers m
// [JK08]: v_i = a_1 v_(i-1) + ... + v_(i-s) + v_(i-s) / 2^s, sums without carry.
Columns columns(int s, std::uint32_t a, std::initializer_list<std::uint32_t> m) {
  Columns v{};
  int i = 0;
  for (const std::uint32_t initial : m) {
    v[static_cast<std::size_t>(i)] = initial << (31 - i);
    ++i;
  }
  for (; i < 32; ++i) {
    const auto at = [&](int j) -> std::uint32_t& { return v[static_cast<std::size_t>(j)]; };
    at(i) = at(i - s) ^ (at(i - s) >> s);
    for (int k = 1; k < s; ++k)
      if (a >> (s - 1 - k) & 1U) at(i) ^= at(i - k);
  }
  return v;
}

// The first coordinate is the radical inverse.
Columns radical_inverse() {
  Columns v{};
  for (std::size_t i = 0; i < 32; ++i) v[i] = 1U << (31 - i);
  return v;
}

const std::array<Columns, LowDiscrepancy::max_dimensions> sobol = {
    radical_inverse(), columns(1, 0, {1}), columns(2, 1, {1, 3}), columns(3, 1, {1, 3, 1}),
    columns(3, 2, {1, 1, 1})};

std::uint32_t reversed(std::uint32_t x) {
  x = (x & 0x55555555U) << 1 | (x >> 1 & 0x55555555U);
  x = (x & 0x33333333U) << 2 | (x >> 2 & 0x33333333U);
  x = (x & 0x0f0f0f0fU) << 4 | (x >> 4 & 0x0f0f0f0fU);
  return __builtin_bswap32(x);
}

// A hash in which each bit depends on lower ones alone; between two reversals, each digit is
// permuted by the digits above it: Owen's scrambling. Laine and Karras's form with the constants
// of [B20].
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x = reversed(x);
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return reversed(x);
}

}  // namespace

LowDiscrepancy::LowDiscrepancy(int dimensions, std::uint64_t seed, std::uint64_t key) {
  assert(dimensions >= 1 && dimensions <= max_dimensions);
  Rng rng(seed, Stream::low_discrepancy, key);
  for (int d = 0; d < dimensions; ++d) scramble_[static_cast<std::size_t>(d)] = rng.next_u32();
}

double LowDiscrepancy::operator()(std::uint64_t i, int dimension) const {
  const auto d = static_cast<std::size_t>(dimension);
  std::uint32_t x = 0;
  for (std::size_t bit = 0; i != 0; i >>= 1, ++bit)
    if (i & 1U) x ^= sobol[d][bit];
  return std::ldexp(static_cast<double>(scrambled(x, scramble_[d])), -32);
}

}  // namespace knotlight
