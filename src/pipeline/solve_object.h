// One translucent object in one channel: photons -> solution by the chosen method -> energy balance
// -> verdict.
#pragma once

#include <string>
#include <vector>

#include "pipeline/channel_problem.h"
#include "pipeline/report.h"

namespace knotlight {

// A channel of an object, solved.
struct SolvedChannel {
  PhotonHalves photons;
  FieldValues U_d;  // not-a-number everywhere if the method did not come to a solution
  bool solved;
  ChannelReport report;
  std::vector<std::string> failures;  // checks that failed, one sentence each

  double U_d_at(const Vec3& x) const { return U_d(x)[0]; }
};

// The method that `solver.method: auto` stands for.
Method chosen_method(const SolverSettings& settings);

// grids: of this object if the chosen method is grid, else null.
SolvedChannel solve_channel(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                            int channel, const ObjectGrids* grids,
                            std::vector<VolumePhoton> photons, std::uint64_t seed,
                            const Workers& workers);

}  // namespace knotlight
