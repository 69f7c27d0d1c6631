#include "stability/methods.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bkm/assembly.h"
#include "bkm/dense_solver.h"
#include "bkm/field.h"
#include "bkm/global_solver.h"
#include "bkm/knots.h"
#include "bkm/local_solver.h"
#include "bkm/thesis_solver.h"
#include "core/not_finite.h"
#include "core/rng.h"
#include "grid/solver.h"

namespace knotlight {
namespace {

constexpr std::size_t check_count = 400;  // apart by an eighth of the radius
// What the program's bkm and mfs drop too.
constexpr double pivot_cut = 1e-12;
// Patches choose 60 of these each; grids take as many per cell's face of surface.
constexpr std::size_t patch_knots = 1 << 15;
constexpr double points_per_face = 10.0;

const Workers alone(1);

// Points of the surface that are no knots: random ones, and the foot of the sources, where the
// fields are largest: near sources may be seen nowhere else.
struct Checks {
  Points positions{3, check_count + 1}, normals{3, check_count + 1};

  explicit Checks(const BoundaryCase& c) {
    for (std::size_t i = 0; i < check_count; ++i) {
      Rng rng(c.seed, Stream::check_points, i);
      const double u = rng.uniform();
      const SurfacePoint p = c.body->point(u, rng.uniform());
      positions.col(static_cast<Eigen::Index>(i)) = p.position;
      normals.col(static_cast<Eigen::Index>(i)) = p.normal;
    }
    positions.rightCols(1) = c.body->foot.position;
    normals.rightCols(1) = c.body->foot.normal;
  }
};

// Eigen's own maximum may pass over not-a-number.
double largest(const Eigen::VectorXd& v) {
  return v.hasNaN() ? nan : v.lpNorm<Eigen::Infinity>();
}

Eigen::VectorXd values_at(const Points& x, const std::function<double(const Vec3&)>& u) {
  Eigen::VectorXd values(x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) values[i] = u(x.col(i));
  return values;
}

// Box and Muller's normal variates, one per datum and kind of data.
Eigen::VectorXd with_noise(Eigen::VectorXd b, double noise, std::uint64_t seed) {
  const double size = noise * b.norm() / std::sqrt(static_cast<double>(b.size()));
  for (Eigen::Index i = 0; size > 0.0 && i < b.size(); ++i) {
    Rng rng(seed, Stream::boundary_knots, static_cast<std::uint64_t>(i));
    const double radius = std::sqrt(-2.0 * std::log1p(-rng.uniform()));
    b[i] += size * radius * std::cos(2.0 * std::numbers::pi * rng.uniform());
  }
  return b;
}

Eigen::VectorXd robin_data(const BoundaryCase& c, const ExactField& field, double noise,
                           const Points& x, const Points& n) {
  Eigen::VectorXd g(x.cols());
  for (Eigen::Index i = 0; i < g.size(); ++i)
    g[i] = field.value(x.col(i)) + c.k * field.gradient(x.col(i)).dot(n.col(i));
  return with_noise(std::move(g), noise, c.seed);
}

// What a method finds for the data of a field: the field, and the sum of sizes of its parts.
struct Found {
  std::function<double(const Vec3&)> value, size;
  double iterations = nan;
};

// Fills in the figures of solutions; those of the system are the same for all.
template <class Solve>
std::vector<Outcome> outcomes(const BoundaryCase& c, const Outcome& system, const Solve& solve) {
  const Checks checks(c);
  std::vector<Outcome> results;
  for (const ExactField& field : c.fields) {
    const Eigen::VectorXd exact = values_at(checks.positions, field.value);
    for (const double noise : c.noises) {
      const Found found = solve(field, noise);
      Outcome outcome = system;
      outcome.error = largest(values_at(checks.positions, found.value) - exact) / largest(exact);
      outcome.coefficient_size =
          found.size ? largest(values_at(checks.positions, found.size)) / largest(exact) : nan;
      outcome.iterations = found.iterations;
      results.push_back(outcome);
    }
  }
  return results;
}

// Least squares over a global basis about `centers`, which the first of the knots belong to.
std::vector<Outcome> try_global(const BoundaryCase& c, GlobalBasis basis, const Points& centers,
                                const SpreadKnots& knots) {
  const GlobalBkmSolver solver({c.lambda, c.k, centers, knots.positions, knots.normals}, basis,
                               pivot_cut, alone);
  const auto unknowns = static_cast<double>(centers.cols());
  const Outcome system{nan, unknowns, static_cast<double>(solver.rank()), solver.condition(),
                       nan, nan};
  return outcomes(c, system, [&](const ExactField& field, double noise) {
    const GlobalField found =
        solver.solve(robin_data(c, field, noise, knots.positions, knots.normals));
    // All basis functions are positive.
    const GlobalField sizes(basis, c.lambda, centers, found.coefficients().cwiseAbs());
    return Found{[found](const Vec3& x) { return found.value(x); },
                 [sizes](const Vec3& x) { return sizes.value(x); }, nan};
  });
}

Points first(const Points& all, std::size_t count) {
  return all.leftCols(static_cast<Eigen::Index>(count));
}

}  // namespace

std::vector<Outcome> try_thesis(const BoundaryCase& c, std::size_t count, DenseMethod method,
                                double cut) {
  const SpreadKnots knots = spread_over(*c.body, count);
  RadialFunction wave;
  wave.kind = RadialKind::nonsingular;
  wave.order = 0;
  wave.lambda = c.lambda;
  wave.R = 2.0 * c.body->half_extent;
  const DenseSolver solver(robin_matrix(knots.positions, knots.normals, knots.positions, c.k, wave),
                           {method, cut, alone});
  const Outcome system{
      nan, static_cast<double>(count), static_cast<double>(solver.rank()), solver.condition(), nan,
      nan};
  BkmBasis basis;
  basis.centers = PointColumns(0, 3);
  basis.knots = point_columns(knots.positions);
  basis.homogeneous = wave;
  return outcomes(c, system, [&](const ExactField& field, double noise) {
    const Eigen::VectorXd beta =
        solver.solve(robin_data(c, field, noise, knots.positions, knots.normals));
    const BkmField found(basis, {}, beta), sizes(basis, {}, beta.cwiseAbs());
    return Found{[found](const Vec3& x) { return found.value(x); },
                 [sizes](const Vec3& x) { return sizes.value(x); }, nan};
  });
}

std::vector<Outcome> try_bkm(const BoundaryCase& c, std::size_t count) {
  const SpreadKnots knots = spread_over(*c.body, 2 * count);
  return try_global(c, GlobalBasis::nonsingular_solutions, first(knots.positions, count), knots);
}

std::vector<Outcome> try_mfs(const BoundaryCase& c, std::size_t count, double distance) {
  const SpreadKnots knots = spread_over(*c.body, 2 * count);
  Points centers = first(knots.positions, count);
  // As in the program: no source nearer to the surface than half of its distance.
  for (Eigen::Index i = 0; i < centers.cols(); ++i) {
    double d = distance * mean_knot_spacing(c.body->area, count);
    while (c.body->depth(centers.col(i) + d * knots.normals.col(i)) > -0.5 * d) d *= 0.5;
    centers.col(i) += d * knots.normals.col(i);
  }
  return try_global(c, GlobalBasis::exterior_sources, centers, knots);
}

std::vector<Outcome> try_lbkm(const BoundaryCase& c, double width, int degree) {
  const auto knots = std::make_shared<const SpreadKnots>(spread_over(*c.body, patch_knots));
  const BodyQueries body = queries(*c.body);
  PatchTreeOptions patches;
  patches.coarsest_per_size = 1.0;
  patches.widest = width;
  const auto tree = std::make_shared<PatchTree>(knots, patches);
  tree->make_patches(body, alone);
  LocalBkmOptions options;
  options.degree = degree;
  const LocalBkmSolver solver(tree, body, c.lambda, c.k, options, alone);
  const Outcome system{nan, static_cast<double>(solver.unknowns()), nan, nan, nan, nan};
  return outcomes(c, system, [&](const ExactField& field, double noise) {
    const LocalSolution solution =
        solver.solve(robin_data(c, field, noise, knots->positions, knots->normals), alone);
    const LocalField found = solver.field(solution, body);
    // Waves are of size 1 on the sphere around their patch.
    const double size = largest(solution.beta);
    return Found{[found](const Vec3& x) { return found.value(x); },
                 [size](const Vec3&) { return size; }, static_cast<double>(solution.iterations)};
  });
}

std::vector<Outcome> try_grid(const BoundaryCase& c, double h) {
  const auto geometry = std::make_shared<const GridGeometry>(c.body->shape, h, alone);
  const GridSolver solver(geometry, c.lambda, c.k);
  const SpreadKnots points =
      spread_over(*c.body, static_cast<std::size_t>(points_per_face * c.body->area / (h * h)));
  const Eigen::VectorXd areas = Eigen::VectorXd::Constant(
      points.positions.cols(), c.body->area / static_cast<double>(points.positions.cols()));
  const double unknowns = geometry->finest().dofs;
  const Outcome system{nan, unknowns, unknowns, nan, nan, nan};  // positive definite
  const Checks checks(c);
  std::vector<Outcome> results;
  for (const ExactField& field : c.fields) {
    const Eigen::VectorXd exact = values_at(checks.positions, field.value);
    for (const double noise : c.noises) {
      GridLoad load(*geometry);
      load.add_boundary_data(points.positions, points.normals, areas,
                             robin_data(c, field, noise, points.positions, points.normals), c.k);
      const GridSolution solution = solver.solve(load);
      Outcome outcome = system;
      outcome.error =
          largest(solution.field.values(checks.positions, checks.normals) - exact) / largest(exact);
      outcome.coefficient_size = largest(solution.field.nodes()) / largest(exact);
      outcome.iterations = solution.iterations;
      results.push_back(outcome);
    }
  }
  return results;
}

std::vector<Outcome> try_dual_reciprocity(const BoundaryCase& c, double s, std::size_t count,
                                          RadialKind radial, double width) {
  const SpreadKnots knots = spread_over(*c.body, count);
  BkmThesisProblem problem{c.lambda, c.k, knots.positions, knots.normals, {}};
  problem.interior_points =
      interior_knots(knots.positions, knots.normals, {1.0 / s, 1.5 / s}, [&](const Vec3& x) {
        return c.body->depth(x) > 0.0;
      }).points;
  BkmThesisOptions options;
  options.radial = radial;
  options.exponent = radial == RadialKind::inverse_multiquadric ? 3.0 : 1.0;
  options.c = width * mean_knot_spacing(c.body->area, count);
  const BkmThesisSolver solver(problem, options);
  const Points all = all_points(problem);
  const Outcome system{nan,
                       static_cast<double>(all.cols()),
                       static_cast<double>(solver.particular_rank()),
                       solver.particular_condition(),
                       nan,
                       nan};
  return outcomes(c, system, [&](const ExactField& field, double noise) {
    const Eigen::VectorXd f = (s * s - c.lambda * c.lambda) * values_at(all, field.value);
    const BkmField found =
        solver.solve(with_noise(f, noise, c.seed + 1),
                     robin_data(c, field, noise, knots.positions, knots.normals));
    return Found{[found](const Vec3& x) { return found.value(x); }, nullptr, nan};
  });
}

}  // namespace knotlight
