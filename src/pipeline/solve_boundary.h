// What `method: auto` does with objects too dense for a grid: the boundary methods, by measured
// error.
#pragma once

#include "pipeline/channel_problem.h"

namespace knotlight {

// bkm first, which is done with some hundred knots where the surface is smooth; lbkm where bkm's
// error estimate exceeds the tolerance because of what it leaves of the boundary condition, not
// because of noise. The one with the smaller estimate is handed on.
ChannelSolution solve_by_boundary(const ChannelProblem& problem);

}  // namespace knotlight
