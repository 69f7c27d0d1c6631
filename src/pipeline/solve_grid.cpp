#include "pipeline/solve_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "grid/error_estimate.h"
#include "grid/solver.h"
#include "pipeline/grid_load.h"

namespace knotlight {
namespace {

// A coarse tolerance may ask for cells that the shape's thin parts do not allow. They shrink by
// this until it does, at most to those of the default tolerance; a grid of each size costs little
// then.
constexpr double shrink = 0.7;
constexpr double lost_allowed = 1e-3;  // share of the sources that found no cell
// Residual of the linear systems per tolerance: the field's rms error from it was half of it or
// less, so this is far below the error of the cells. It counts in full in the estimate.
constexpr double linear_share = 0.03;
// The halves' difference need not be known any better. It is of the size of a cell: rays of low
// discrepancy have hardly any smoother noise, and larger cells would not see it.
constexpr double noise_residual = 0.1;

// The multigrid hierarchies of both grids.
struct GridFactors {
  GridSolver fine;
  std::optional<GridSolver> coarse;
};

std::shared_ptr<const GridFactors> kept_factors(const ChannelProblem& p) {
  const FactorCache::Key key = p.factor_key(Method::grid);
  auto factors = p.factors.find<GridFactors>(key);
  if (!factors) {
    const double lambda = p.coefficients.lambda, k = p.coefficients.k;
    auto made = std::make_shared<GridFactors>(GridFactors{{p.grids->fine, lambda, k}, {}});
    if (p.grids->coarse) made->coarse.emplace(p.grids->coarse, lambda, k);
    factors = made;
    p.factors.put(key, factors);
  }
  return factors;
}

Eigen::VectorXd mean_of(const std::array<GridLoad, 2>& loads) {
  return 0.5 * (loads[0].values() + loads[1].values());
}

// On cells of twice the size.
GridSolution solve_coarse(const ChannelProblem& p, const GridFactors& factors,
                          const std::array<GridLoad, 2>& fine_loads, double tolerance) {
  if (!factors.coarse) return factors.fine.solve_coarse(mean_of(fine_loads), tolerance);
  return factors.coarse->solve(mean_of({incident_load(*p.grids->coarse, p.light.halves[0], p),
                                        incident_load(*p.grids->coarse, p.light.halves[1], p)}),
                               tolerance);
}

}  // namespace

CellSize grid_cell_size(const Object& object, int channels, const SolverSettings& settings) {
  double sigma_tr = 0.0;
  double sigma_t = 0.0;
  for (int c = 0; c < channels; ++c) {
    const Medium medium = object.translucent()->medium(c);
    sigma_tr = std::max(sigma_tr, medium.sigma_tr());
    sigma_t = std::max(sigma_t, medium.sigma_t());
  }
  return cell_size_for(object.shape, sigma_tr, sigma_t, settings.tolerance,
                       cell_budget(settings.tolerance));
}

std::shared_ptr<const GridGeometry> resolving_geometry(const Object& object, int channels,
                                                       const SolverSettings& settings,
                                                       const Workers& workers) {
  double h = grid_cell_size(object, channels, settings).h;
  SolverSettings usual = settings;
  usual.tolerance = SolverSettings().tolerance;
  const double least = grid_cell_size(object, channels, usual).h;
  auto geometry = std::make_shared<GridGeometry>(object.shape, h, workers);
  while (!geometry->resolved() && h > least) {
    h = std::max(least, shrink * h);
    geometry = std::make_shared<GridGeometry>(object.shape, h, workers);
  }
  return geometry;
}

ObjectGrids make_grids(const Object& object, int channels, const SolverSettings& settings,
                       const Workers& workers) {
  ObjectGrids grids;
  grids.fine = resolving_geometry(object, channels, settings, workers);
  if (grids.fine->ok() && !grids.fine->has_nested_coarse())
    grids.coarse = std::make_shared<GridGeometry>(object.shape, 2.0 * grids.fine->h(), workers);
  return grids;
}

ChannelSolution solve_by_grid(const ChannelProblem& p) {
  const ObjectGrids& grids = *p.grids;
  ChannelSolution solution;
  if (!grids.fine->ok() || (grids.coarse && !grids.coarse->ok())) {
    solution.failures.push_back("the grid cannot hold the object: " +
                                (grids.fine->ok() ? grids.coarse : grids.fine)->failure());
    return solution;
  }

  const std::shared_ptr<const GridFactors> factors = kept_factors(p);
  const double tolerance = linear_share * p.settings.tolerance;
  const std::array<GridLoad, 2> loads{incident_load(*grids.fine, p.light.halves[0], p),
                                      incident_load(*grids.fine, p.light.halves[1], p)};
  const GridSolution coarse = solve_coarse(p, *factors, loads, tolerance);
  // The coarse field is a start only where its nodes are the fine grid's.
  const GridSolution mean = factors->fine.solve(
      mean_of(loads), tolerance, factors->coarse ? Eigen::VectorXd() : coarse.field.nodes());
  const GridSolution noise = factors->fine.solve(
      Eigen::VectorXd(0.5 * (loads[0].values() - loads[1].values())), noise_residual);
  const GridField& field = mean.field;

  const SurfaceSamples checks = boundary_check_points(p);
  const Eigen::VectorXd u = field.values(checks.positions, checks.normals);
  const GridErrorEstimate estimate =
      estimate_error(field, coarse.field, checks.positions, checks.normals,
                     p.coefficients.lambda * grids.fine->h());
  // Both relative to the rms over the surface.
  solution.numerical_error =
      relative(estimate.rms * estimate.scale, root_mean_square(u)) + mean.residual;
  solution.noise = relative(root_mean_square(noise.field.values(checks.positions, checks.normals)),
                            root_mean_square(u));

  const bool converged = mean.converged && coarse.converged && noise.converged;
  solution.solved = field.nodes().allFinite() && u.allFinite();
  if (!converged) solution.failures.push_back("the linear solver did not converge");
  if (!solution.solved) solution.failures.push_back("the solution has values that are not finite");
  if (!grids.fine->resolved())
    solution.failures.push_back("the grid does not resolve the object: " +
                                grids.fine->unresolved());
  const double cell_in_mean_free_paths = grids.fine->h() * p.medium.sigma_tr();
  if (cell_in_mean_free_paths > coarsest_cells)
    solution.failures.push_back(
        fmt::format("cells of {:.2g} transport mean free paths do not resolve the light's first "
                    "scattering, expected at most {}",
                    cell_in_mean_free_paths, coarsest_cells));
  const double lost = relative(loads[0].lost() + loads[1].lost(),
                               std::abs(loads[0].total()) + std::abs(loads[1].total()));
  if (!(lost <= lost_allowed))
    solution.failures.push_back(fmt::format("{:.2g} of the sources found no cell", lost));

  solution.figures = {{"cells", static_cast<double>(grids.fine->quality().cells)},
                      {"cell_size", grids.fine->h()},
                      {"cell_size_in_transport_mean_free_paths", cell_in_mean_free_paths},
                      {"iterations", static_cast<double>(mean.iterations)},
                      {"linear_residual", mean.residual},
                      {"sources_lost", lost},
                      {"discrete_energy_imbalance", std::abs(mean.imbalance)},
                      {"largest_grid_difference", estimate.largest}};
  solution.on_grid = field;
  solution.U_d = [field](const Points& x) { return field.values(x); };
  return solution;
}

}  // namespace knotlight
