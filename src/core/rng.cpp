#include "core/rng.h"

namespace knotlight {
namespace {

// SplitMix64 finaliser [S14]: a bijection that turns neighbouring keys into unrelated ones.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

Rng::Rng(std::uint64_t seed, Stream purpose, std::uint64_t index)
    : state_(mix(mix(seed) ^ mix(index))),
      increment_((mix(mix(index) + mix(seed ^ static_cast<std::uint64_t>(purpose) << 32)) << 1) |
                 1U) {
  state_ = mix(state_ ^ increment_);
}

std::uint32_t Rng::next_u32() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + increment_;
  const auto xorshifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
  const auto rotation = static_cast<std::uint32_t>(old >> 59U);
  return (xorshifted >> rotation) | (xorshifted << ((32U - rotation) & 31U));
}

double Rng::uniform() {
  const std::uint64_t high = next_u32() >> 5U;  // 27 bits
  const std::uint64_t low = next_u32() >> 6U;   // 26 bits
  return static_cast<double>((high << 26U) | low) * 0x1p-53;
}

}  // namespace knotlight
