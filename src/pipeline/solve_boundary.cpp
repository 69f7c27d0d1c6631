#include "pipeline/solve_boundary.h"

#include "pipeline/solve_global.h"
#include "pipeline/solve_lbkm.h"

namespace knotlight {

ChannelSolution solve_by_boundary(const ChannelProblem& problem) {
  ChannelSolution global = solve_by_bkm(problem);
  const double tolerance = problem.settings.tolerance;
  if (global.numerical_error <= 0.5 * tolerance) return global;
  ChannelSolution local = solve_by_lbkm(problem);
  const bool better = local.failures.size() <= global.failures.size() &&
                      local.numerical_error + local.noise < global.numerical_error + global.noise;
  return better ? std::move(local) : std::move(global);
}

}  // namespace knotlight
