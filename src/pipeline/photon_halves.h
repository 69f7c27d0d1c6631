// The photons of one object in one channel as two independent halves (the first and the second half
// of those emitted: a path may leave several photons, which must stay together): the solution is
// the mean of what the halves give, half their difference is its noise.
#pragma once

#include <vector>

#include "photon/photon_map.h"
#include "scene/scene.h"

namespace knotlight {

// How the scene wants densities estimated.
EstimateOptions estimate_options(const SolverSettings& settings);

struct PhotonHalves {
  std::vector<VolumePhotonMap> maps;  // 2; the photons of each carry twice their power

  PhotonHalves(std::vector<VolumePhoton> photons, const Medium& medium);

  std::size_t size() const { return maps[0].size() + maps[1].size(); }
  double total_power() const { return 0.5 * (maps[0].total_power() + maps[1].total_power()); }  // W
  // Mean of both halves' estimates, W/(length^2 sr).
  double U_ri(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
              std::uint32_t object) const;
};

}  // namespace knotlight
