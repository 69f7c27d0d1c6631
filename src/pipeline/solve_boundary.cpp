#include "pipeline/solve_boundary.h"

#include "pipeline/solve_global.h"
#include "pipeline/solve_grid.h"
#include "pipeline/solve_lbkm.h"

namespace knotlight {
namespace {

// Beyond so many tolerances the run would not be trusted: the grid, its cells larger than wanted,
// may still do better.
constexpr double tolerances_accepted = 3.0;

double estimate(const ChannelSolution& s) {
  return s.numerical_error + s.noise;
}

// The better of two: one that could do what it should, then the smaller estimate. Not-a-number
// loses.
ChannelSolution better(ChannelSolution a, ChannelSolution b) {
  if (a.solved != b.solved) return a.solved ? std::move(a) : std::move(b);
  if (a.failures.size() != b.failures.size())
    return a.failures.size() < b.failures.size() ? std::move(a) : std::move(b);
  return estimate(b) < estimate(a) ? std::move(b) : std::move(a);
}

}  // namespace

ChannelSolution solve_by_boundary(const ChannelProblem& p) {
  const BoundaryStart start = boundary_start(p);
  ChannelSolution best = solve_by_bkm(p, start);
  if (best.numerical_error > residual_wanted(p))
    best = better(std::move(best), solve_by_lbkm(p, start));
  if (estimate(best) <= tolerances_accepted * p.settings.tolerance && best.failures.empty())
    return best;
  const ObjectGrids grids =
      make_grids(p.scene.objects[p.object], p.scene.channels, p.settings, p.workers);
  ChannelProblem on_grid = p;
  on_grid.grids = &grids;
  return better(std::move(best), solve_by_grid(on_grid));
}

}  // namespace knotlight
