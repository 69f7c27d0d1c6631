// `method: lbkm`: photons in closed form, and small boundary knot problems in overlapping patches.
#pragma once

#include "pipeline/homogeneous.h"

namespace knotlight {

ChannelSolution solve_by_lbkm(const ChannelProblem& problem, const BoundaryStart& start);

}  // namespace knotlight
