// `method: bkm` and `mfs`: photons in closed form, and one dense least-squares system for the
// boundary.
#pragma once

#include "pipeline/homogeneous.h"

namespace knotlight {

// Non-singular solutions about knots on the surface.
ChannelSolution solve_by_bkm(const ChannelProblem& problem, const BoundaryStart& start);
// Singular ones about points outside.
ChannelSolution solve_by_mfs(const ChannelProblem& problem, const BoundaryStart& start);

}  // namespace knotlight
