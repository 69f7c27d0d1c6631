// One translucent object in one channel: photons -> source and boundary data -> boundary knot solve
// -> checks.
#pragma once

#include <optional>
#include <vector>

#include "bkm/thesis_solver.h"
#include "photon/photon_map.h"
#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// The photons of one object in one channel as two independent halves (even and odd photons): the
// solution is the mean of what the halves give, half their difference is its noise.
struct PhotonHalves {
  std::vector<VolumePhotonMap> maps;  // 2

  PhotonHalves(std::vector<VolumePhoton> photons, const Medium& medium);
  std::size_t size() const { return maps[0].size() + maps[1].size(); }
  double total_power() const { return 0.5 * (maps[0].total_power() + maps[1].total_power()); }
  double U_ri(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
              std::uint32_t object) const;
};

// A channel of an object, solved.
struct SolvedChannel {
  PhotonHalves photons;
  BkmField field;  // U_d, W/(length^2 sr)
  ChannelReport report;
  std::vector<std::string> failures;  // checks that failed, one sentence each
};

EstimateOptions estimate_options(const SolverSettings& settings);

SolvedChannel solve_channel(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                            int channel, std::vector<VolumePhoton> photons, std::uint64_t seed,
                            const Workers& workers);

}  // namespace knotlight
