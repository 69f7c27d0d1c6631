#include "pipeline/photon_halves.h"

namespace knotlight {

EstimateOptions estimate_options(const SolverSettings& settings) {
  EstimateOptions options;
  if (settings.estimate_photons) options.nearest = *settings.estimate_photons;
  return options;
}

PhotonHalves::PhotonHalves(std::vector<VolumePhoton> photons, const Medium& medium) {
  std::vector<VolumePhoton> even;
  std::vector<VolumePhoton> odd;
  even.reserve(photons.size() / 2 + 1);
  odd.reserve(photons.size() / 2 + 1);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    photons[i].power *= 2.0;
    (i % 2 == 0 ? even : odd).push_back(photons[i]);
  }
  maps.emplace_back(std::move(even), medium);
  maps.emplace_back(std::move(odd), medium);
}

double PhotonHalves::U_ri(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
                          std::uint32_t object) const {
  return 0.5 * (maps[0].estimate(x, options, caster, object).U_ri +
                maps[1].estimate(x, options, caster, object).U_ri);
}

}  // namespace knotlight
