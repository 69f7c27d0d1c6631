// `method: bkm_thesis`: density estimates at knots, then the thesis's boundary knot method.
#pragma once

#include "pipeline/channel_problem.h"

namespace knotlight {

ChannelSolution solve_by_bkm_thesis(const ChannelProblem& problem);

}  // namespace knotlight
