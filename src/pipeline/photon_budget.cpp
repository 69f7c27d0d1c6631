#include "pipeline/photon_budget.h"

#include <algorithm>

namespace knotlight {
namespace {

constexpr std::size_t first_share = 16;
constexpr std::size_t least_photons = 20'000;  // with fewer nothing is trusted
// Beside the error of the cells, which is about as large, this is hardly to be noticed.
constexpr double noise_accepted = 0.5;  // of the tolerance
// Aimed at where that is exceeded: the noise of two halves is known to some 30 %.
constexpr double noise_wanted = 0.35;

}  // namespace

std::size_t first_photons(std::size_t most) {
  return std::min(most, std::max(most / first_share, least_photons));
}

std::size_t photons_needed(const Report& solution, std::size_t tried, std::size_t most,
                           double tolerance) {
  double noise = 0.0;
  for (const ObjectReport& object : solution.objects)
    for (const ChannelReport& channel : object.channels)
      noise = noise >= channel.noise ? noise : channel.noise;  // not-a-number stays
  if (noise <= noise_accepted * tolerance) return tried;
  const double ratio = noise / (noise_wanted * tolerance);
  const double wanted = static_cast<double>(tried) * ratio * ratio;
  return wanted < static_cast<double>(most) ? static_cast<std::size_t>(wanted) : most;
}

}  // namespace knotlight
