#include "pipeline/solve_global.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bkm/global_solver.h"
#include "bkm/knots.h"
#include "pipeline/homogeneous.h"

namespace knotlight {
namespace {

constexpr std::size_t first_knots = 200;
constexpr std::size_t most_knots = 1600;  // matrices of 3200 x 1600, some seconds to factor
constexpr std::size_t rows_per_knot = 2;  // oversampling: least squares average over noise
// Pivots that noise and rounding of the data make worthless anyway.
constexpr double cut = 1e-12;
// Exterior sources at this many knot spacings keep full rank and still resolve what the knots do
// (docs/results/stability.md).
constexpr double source_distance = 3.0;
constexpr double misfit_allowed = 0.5;  // of the tolerance
constexpr double worth_doubling =
    0.7;  // the residual must fall to this for knots to be doubled again

HomogeneousPart part(const GlobalField& field, double k) {
  return {[field](const Vec3& x) { return field.value(x); },
          [field, k](const Vec3& x, const Vec3& n) { return field.robin(x, n, k); }};
}

// Where the sources go: outwards from the surface, but not so far that they come near another part
// of it: no nearer than half of their own distance.
Points sources_outside(const Points& positions, const Points& normals, double distance,
                       const ChannelProblem& p) {
  constexpr double keep_clear = 0.5;
  constexpr int most_halvings = 8;
  Points sources(3, positions.cols());
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Vec3 x = positions.col(i), n = normals.col(i);
    double d = distance;
    for (int tries = 0; tries < most_halvings; ++tries, d *= 0.5) {
      const Vec3 y = x + d * n;
      if (p.caster.inside(y, p.object)) continue;
      if ((p.caster.nearest_surface_point(y, p.object).position - y).norm() >= keep_clear * d)
        break;
    }
    sources.col(i) = x + d * n;
  }
  return sources;
}

Method method_of(GlobalBasis basis) {
  return basis == GlobalBasis::exterior_sources ? Method::mfs : Method::bkm;
}

struct GlobalFactors {
  std::size_t count;  // of basis functions
  SpreadKnots knots;
  GlobalBkmSolver solver;
};

// The system with so many knots, factored now or by an earlier light.
std::shared_ptr<const GlobalFactors> kept_factors(const ChannelProblem& p, GlobalBasis basis,
                                                  std::size_t count) {
  const FactorCache::Key key = p.factor_key(method_of(basis));
  if (auto kept = p.factors.find<GlobalFactors>(key); kept && kept->count == count) return kept;
  SpreadKnots knots = spread_surface_knots(p.shape, rows_per_knot * count, p.seed);
  const auto n = static_cast<Eigen::Index>(count);
  GlobalBkmProblem problem{p.coefficients.lambda, p.coefficients.k, knots.positions.leftCols(n),
                           knots.positions, knots.normals};
  if (basis == GlobalBasis::exterior_sources)
    problem.centers = sources_outside(problem.centers, knots.normals.leftCols(n),
                                      source_distance * mean_knot_spacing(knots.area, count), p);
  auto factors = std::make_shared<const GlobalFactors>(
      GlobalFactors{count, std::move(knots),
                    GlobalBkmSolver(std::move(problem), basis,
                                    p.settings.thesis.svd_cut.value_or(cut), p.workers)});
  p.factors.put(key, factors);
  return factors;
}

ChannelSolution solve_by_global(const ChannelProblem& p, GlobalBasis basis) {
  ChannelSolution solution;
  const double k = p.coefficients.k;
  const auto particular = std::make_shared<const ParticularSolution>(p, particular_options(p));
  const BoundaryChecks checks = boundary_checks(p, *particular);
  const std::size_t least = p.settings.knots.value_or(first_knots);
  const std::size_t most = p.settings.knots.value_or(most_knots);

  BoundaryVerdict verdict;
  std::size_t count = least;
  // An earlier light has found out how many knots it takes.
  if (const auto kept = p.factors.find<GlobalFactors>(p.factor_key(method_of(basis))))
    count = kept->count;
  const std::size_t first = count;
  for (;; count *= 2) {
    const std::shared_ptr<const GlobalFactors> factors = kept_factors(p, basis, count);
    const GlobalBkmSolver& solver = factors->solver;
    const BoundaryData data =
        boundary_data(p, *particular, factors->knots.positions, factors->knots.normals, p.seed);
    const GlobalField halves[2] = {solver.solve(data.g[0]), solver.solve(data.g[1])};
    const BoundaryVerdict found =
        judge_boundary(p, checks, {part(halves[0], k), part(halves[1], k)});
    const bool worthwhile =
        count == first || found.robin_residual < worth_doubling * verdict.robin_residual;
    if (count == first || found.robin_residual < verdict.robin_residual) {
      verdict = found;
      const GlobalField mean(basis, p.coefficients.lambda, solver.problem().centers,
                             0.5 * (halves[0].coefficients() + halves[1].coefficients()));
      solution = boundary_solution(p, particular, verdict, part(mean, k));
      solution.method = method_of(basis);
      solution.figures.insert(
          solution.figures.end(),
          {{"boundary_knots", static_cast<double>(count)},
           {"homogeneous_rank", static_cast<double>(solver.rank())},
           {"homogeneous_condition", solver.condition()},
           {"largest_coefficient",
            relative(mean.coefficients().cwiseAbs().maxCoeff(), verdict.scale)}});
    }
    if (!worthwhile || 2 * count > most ||
        found.robin_residual <= misfit_allowed * p.settings.tolerance)
      break;
  }
  return solution;
}

}  // namespace

ChannelSolution solve_by_bkm(const ChannelProblem& p) {
  return solve_by_global(p, GlobalBasis::nonsingular_solutions);
}

ChannelSolution solve_by_mfs(const ChannelProblem& p) {
  return solve_by_global(p, GlobalBasis::exterior_sources);
}

}  // namespace knotlight
