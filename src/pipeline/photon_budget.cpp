#include "pipeline/photon_budget.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

constexpr std::size_t first_share = 16;
constexpr std::size_t least_photons = 20'000;  // with fewer nothing is trusted
// Noise that is hardly to be noticed beside the tolerance, or beside the error of the cells where
// that is larger.
constexpr double noise_accepted = 0.6;
// Aimed at where that is exceeded. A guess that falls short costs all its photons and another
// guess; one that goes too far only what it has too many.
constexpr double noise_wanted = 0.7;  // of what is accepted
// Noise falls as n^-0.9 on smooth bodies and n^-1/2 behind many edges.
constexpr double noise_order = 0.65;
constexpr double least_growth = 1.5;
// The difference of two grids holds a part of the noise too: 0.3 to 0.55 on sphere, plate, torus
// and bunny.
constexpr double noise_in_error = 0.4;
// So much of larger errors of the cells counts, in tolerances: three of them in all are not
// trusted.
constexpr double largest_error = 1.5, largest_sum = 2.5;

double accepted(const ChannelReport& channel, double tolerance) {
  const double noise_in_it = noise_in_error * channel.noise;
  const double error = std::sqrt(
      std::max(0.0, channel.numerical_error * channel.numerical_error - noise_in_it * noise_in_it));
  const double noise = noise_accepted * std::clamp(error, tolerance, largest_error * tolerance);
  const double room = largest_sum * tolerance - error;
  return std::min(noise, std::max(room, noise_wanted * noise_accepted * tolerance));
}

}  // namespace

std::size_t first_photons(std::size_t most) {
  return std::min(most, std::max(most / first_share, least_photons));
}

std::size_t photons_needed(const Report& solution, std::size_t tried, std::size_t most,
                           double tolerance) {
  double excess = 0.0;  // the largest noise, over what is accepted
  for (const ObjectReport& object : solution.objects)
    for (const ChannelReport& channel : object.channels) {
      // Dark, or hard to find: only more photons can tell.
      if (channel.photons == 0) return most;
      const double own = channel.noise / accepted(channel, tolerance);
      if (!(own <= excess)) excess = own;
      if (std::isnan(excess)) return most;
    }
  if (excess <= 1.0) return tried;
  const double growth = std::max(std::pow(excess / noise_wanted, 1.0 / noise_order), least_growth);
  const double wanted = growth * static_cast<double>(tried);
  return wanted < static_cast<double>(most) ? static_cast<std::size_t>(wanted) : most;
}

}  // namespace knotlight
