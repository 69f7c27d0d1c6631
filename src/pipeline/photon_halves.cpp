#include "pipeline/photon_halves.h"

namespace knotlight {

EstimateOptions estimate_options(const SolverSettings& settings) {
  EstimateOptions options;
  if (settings.estimate_photons) options.nearest = *settings.estimate_photons;
  return options;
}

PhotonHalves::PhotonHalves(std::vector<VolumePhoton> photons, const Medium& medium) {
  for (VolumePhoton& photon : photons) photon.power *= 2.0;
  const auto middle = photons.begin() + static_cast<std::ptrdiff_t>(photons.size() / 2);
  maps.emplace_back(std::vector<VolumePhoton>(photons.begin(), middle), medium);
  maps.emplace_back(std::vector<VolumePhoton>(middle, photons.end()), medium);
}

double PhotonHalves::U_ri(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
                          std::uint32_t object) const {
  return 0.5 * (maps[0].estimate(x, options, caster, object).U_ri +
                maps[1].estimate(x, options, caster, object).U_ri);
}

}  // namespace knotlight
