#include "pipeline/solve_global.h"

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
constexpr double worth_doubling =
    0.7;  // the residual must fall to this for knots to be doubled again

HomogeneousPart part(const GlobalField& field, double k) {
  return {[field](const Vec3& x) { return field.value(x); },
          [field, k](const Vec3& x, const Vec3& n) { return field.robin(x, n, k); }};
}

// Where the sources go: outwards from the surface, but not so far that they come near another part
// of it: no nearer than half of their own distance. Where there is no such place, there is no
// source.
Points sources_outside(const Points& positions, const Points& normals, double distance,
                       const ChannelProblem& p) {
  constexpr double keep_clear = 0.5;
  constexpr int most_halvings = 8;
  Points sources(3, positions.cols());
  Eigen::Index found = 0;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Vec3 x = positions.col(i), n = normals.col(i);
    // Not through an opposite wall.
    const auto wall = p.caster.nearest({x, n, 2.0 * distance}, p.object);
    double d = wall ? std::min(distance, keep_clear * wall->t) : distance;
    for (int tries = 0; tries < most_halvings; ++tries, d *= 0.5) {
      const Vec3 y = x + d * n;
      if (p.caster.inside(y, p.object)) continue;
      if ((p.caster.nearest_surface_point(y, p.object).position - y).norm() >= keep_clear * d) {
        sources.col(found++) = y;
        break;
      }
    }
  }
  return sources.leftCols(found);
}

Method method_of(GlobalBasis basis) {
  return basis == GlobalBasis::exterior_sources ? Method::mfs : Method::bkm;
}

struct GlobalFactors {
  std::size_t count;  // of basis functions
  SpreadKnots knots;
  GlobalBkmSolver solver;
};

using SharedGlobalFactors = std::shared_ptr<const GlobalFactors>;

SharedGlobalFactors factor(const ChannelProblem& p, GlobalBasis basis, std::size_t count) {
  SpreadKnots knots = spread_surface_knots(p.shape, rows_per_knot * count, p.seed);
  const auto n = static_cast<Eigen::Index>(count);
  GlobalBkmProblem problem{p.coefficients.lambda, p.coefficients.k, knots.positions.leftCols(n),
                           knots.positions, knots.normals};
  if (basis == GlobalBasis::exterior_sources)
    problem.centers = sources_outside(problem.centers, knots.normals.leftCols(n),
                                      source_distance * mean_knot_spacing(knots.area, count), p);
  return std::make_shared<const GlobalFactors>(
      GlobalFactors{count, std::move(knots),
                    GlobalBkmSolver(std::move(problem), basis,
                                    p.settings.thesis.svd_cut.value_or(cut), p.workers)});
}

// One number of knots tried.
struct GlobalRound {
  ChannelSolution solution;
  double residual;
};

GlobalRound solve_on(const GlobalFactors& factors, GlobalBasis basis, const BoundaryStart& start,
                     const ChannelProblem& p) {
  const GlobalBkmSolver& solver = factors.solver;
  const double k = p.coefficients.k;
  const SurfaceSamples at{factors.knots.positions, factors.knots.normals};
  const BoundaryData data = boundary_data(
      p, start.particular->evaluate(at.positions, &at.normals, p.workers), at, p.seed);
  const GlobalField halves[2] = {solver.solve(data.g[0]), solver.solve(data.g[1])};
  const BoundaryVerdict verdict =
      judge_boundary(p, start.checks, {part(halves[0], k), part(halves[1], k)});
  const GlobalField mean(basis, p.coefficients.lambda, solver.problem().centers,
                         0.5 * (halves[0].coefficients() + halves[1].coefficients()));
  GlobalRound round{boundary_solution(p, start.particular, verdict, part(mean, k)),
                    verdict.robin_residual};
  round.solution.method = method_of(basis);
  round.solution.figures.insert(
      round.solution.figures.end(),
      {{"boundary_knots", static_cast<double>(factors.count)},
       {"homogeneous_rank", static_cast<double>(solver.rank())},
       {"homogeneous_condition", solver.condition()},
       {"largest_coefficient",
        relative(mean.coefficients().cwiseAbs().maxCoeff(), verdict.scale)}});
  if (solver.rank() == 0)
    round.solution.failures.push_back(
        "no basis function reaches the surface in double precision: the object is too many "
        "absorption lengths wide");
  return round;
}

ChannelSolution solve_by_global(const ChannelProblem& p, const BoundaryStart& start,
                                GlobalBasis basis) {
  const std::size_t most = p.settings.knots.value_or(most_knots);
  const double wanted = residual_wanted(p);
  const FactorCache::Key key = p.factor_key(method_of(basis));
  const auto kept = p.factors.find<KeptFactors<GlobalFactors>>(key);
  SharedGlobalFactors factors =
      kept ? kept->factors : factor(p, basis, p.settings.knots.value_or(first_knots));

  GlobalRound best = solve_on(*factors, basis, start, p);
  if (kept && kept->serve(best.residual, wanted)) return best.solution;
  double before = best.residual;
  SharedGlobalFactors best_factors = factors;
  while (before > wanted && 2 * factors->count <= most) {
    factors = factor(p, basis, 2 * factors->count);
    GlobalRound next = solve_on(*factors, basis, start, p);
    const bool worthwhile = next.residual < worth_doubling * before;
    before = next.residual;
    if (next.residual < best.residual) {
      best = std::move(next);
      best_factors = factors;
    }
    if (!worthwhile) break;
  }
  p.factors.put(key, std::make_shared<const KeptFactors<GlobalFactors>>(
                         KeptFactors<GlobalFactors>{best_factors, best.residual}));
  return best.solution;
}

}  // namespace

ChannelSolution solve_by_bkm(const ChannelProblem& p, const BoundaryStart& start) {
  return solve_by_global(p, start, GlobalBasis::nonsingular_solutions);
}

ChannelSolution solve_by_mfs(const ChannelProblem& p, const BoundaryStart& start) {
  return solve_by_global(p, start, GlobalBasis::exterior_sources);
}

}  // namespace knotlight
