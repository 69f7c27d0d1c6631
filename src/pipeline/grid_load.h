// The right-hand side of the grid method for each source model (docs/theory.md, sections 6 and 6b).
#pragma once

#include <vector>

#include "grid/solver.h"
#include "pipeline/channel_problem.h"

namespace knotlight {

// -f = strength times a delta function: W/(length sr).
struct PointSource {
  Vec3 position;
  double strength;
};

// Irradiance sampling, energy-consistent: what enters at a point of the surface is scattered
// isotropically one transport mean free path below it, less what is absorbed on the way; in a body
// thinner than twice that, half way through it.
std::vector<PointSource> sources_below(const std::vector<IrradianceSample>& samples,
                                       const Medium& medium, const RayCaster& caster,
                                       std::uint32_t object);

// Of one half of the incident light, with what the object emits itself.
GridLoad incident_load(const GridGeometry& geometry, const IncidentHalf& half,
                       const ChannelProblem& problem);

// U_ri by the photons of both halves, W/(length^2 sr): at each node the mean over the cells around
// it. medium: theirs.
GridField unscattered_on_grid(const std::shared_ptr<const GridGeometry>& geometry,
                              const IncidentLight& light, const Medium& medium);

}  // namespace knotlight
