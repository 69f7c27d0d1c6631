// One translucent object in one channel: photons -> solution by the chosen method -> energy balance
// -> verdict.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/beyond_p1.h"
#include "pipeline/channel_problem.h"
#include "pipeline/report.h"

namespace knotlight {

// A channel of an object, solved.
struct SolvedChannel {
  SourceModel model = SourceModel::photon_map;
  FieldValues U_d;  // not-a-number everywhere if the method did not come to a solution; with
                    // boundary_flux U_ri + U_d, see below
  std::optional<GridField> on_grid;  // the same, of a method that has it on a grid
  // The same at the nodes of the object's surface grid, of a solution that was read from a file.
  std::optional<Eigen::VectorXd> on_surface;
  bool solved = false;
  Medium scattering;              // the object's own, or the similar one (solve_scene)
  std::optional<GridField> U_ri;  // of refracting objects, if a picture is to be gathered
  Equation equation;  // beyond P1, U_d is a part of the field that pictures complete (gather.h)
  ChannelReport report;
  std::vector<std::string> failures;  // checks that failed, one sentence each

  double U_d_at(const Vec3& x) const { return U_d(x)[0]; }
};

// Whether the photons are enough to tell darkness from bad luck, and what to say if not.
bool enough_photons(const Scene& scene);
std::string too_few_photons(const Scene& scene);

// U_d on the surface (positions and outward normals: 3 x N): what leaving_flux and the exitance
// take. The model boundary_flux solves for U_ri + U_d; its U_ri on the surface, entered / (2 pi),
// is taken off here.
Eigen::VectorXd leaving_U_d(const SolvedChannel& channel, const Scene& scene,
                            const RayCaster& caster, std::uint32_t object, int channel_index,
                            const Points& positions, const Points& normals, std::uint64_t seed);

// method: automatic stands for the better of the boundary methods. grids: of
// this object if the method is grid, else null.
SolvedChannel solve_channel(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                            int channel, const Equation& equation, Method method,
                            const ObjectGrids* grids, const IncidentLight& light,
                            std::uint64_t seed, const Workers& workers, FactorCache& factors);

}  // namespace knotlight
