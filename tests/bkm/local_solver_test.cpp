// The localized method on bodies whose solution is known: a source outside, far or near.
#include "bkm/local_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "support/formula_bodies.h"

namespace knotlight {
namespace {

constexpr int knot_bits = 15;

struct Outcome {
  double error;  // relative L2 at points of the surface that are not knots, and inside
  LocalSolution solution;
};

Outcome solve(const FormulaBody& ball, const OutsideSource& source, double k, double widest,
              int degree, int threads = 1) {
  const Workers workers(threads);
  PatchTreeOptions patches;
  patches.coarsest_per_size = 1.0;
  patches.widest = widest;
  const auto tree = std::make_shared<PatchTree>(ball.knots, patches);
  tree->make_patches(ball.queries, workers);
  LocalBkmOptions options;
  options.degree = degree;
  const LocalBkmSolver solver(tree, ball.queries, source.lambda, k, options, workers);
  Eigen::VectorXd g(ball.knots->positions.cols());
  for (Eigen::Index i = 0; i < g.size(); ++i)
    g[i] = source.robin(ball.knots->positions.col(i), ball.knots->normals.col(i), k);
  Outcome outcome{0.0, solver.solve(g, workers)};
  EXPECT_TRUE(outcome.solution.converged);
  const LocalField field = solver.field(outcome.solution, ball.queries);
  Rng rng(5, Stream::check_points, 0);
  double error = 0.0, size = 0.0;
  for (int i = 0; i < 2000; ++i) {
    Vec3 x = Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * 2.0 - Vec3::Ones();
    x *= (i % 2 == 0 ? 1.0 : rng.uniform()) / x.norm();
    const double d = field.value(x) - source.value(x);
    error += d * d;
    size += source.value(x) * source.value(x);
  }
  outcome.error = std::sqrt(error / size);
  return outcome;
}

// Over absorption and extrapolation lengths of several orders: the error of waves of degree 4 in
// patches a third of the distance to the nearest singularity, and no wider than 1/lambda. Measured:
// 4e-4 or less.
TEST(LocalSolver, SolvesAcrossScales) {
  const FormulaBody ball = balls({Vec3::Zero()}, 1.0, knot_bits);
  for (const double lambda : {0.0, 1.0, 4.0})
    for (const double k : {1e-3, 2.0}) {
      const OutsideSource source{Vec3(0.9, 1.0, 1.4), lambda};
      EXPECT_LT(solve(ball, source, k, lambda > 3.0 ? 1.0 / lambda : 0.3, 4).error, 2e-3)
          << lambda << ' ' << k;
    }
}

// Halving the patches at degree p divides the error by 2^p in the limit (the boundary condition has
// a derivative); at these sizes by somewhat less. Measured at degrees 2 and 4: 4.3 and 12.
TEST(LocalSolver, ConvergesAtTheRateOfItsDegree) {
  const FormulaBody ball = balls({Vec3::Zero()}, 1.0, knot_bits);
  const OutsideSource source{Vec3(0.9, 1.0, 1.4), 1.0};
  for (const int degree : {2, 4}) {
    const double coarse = solve(ball, source, 0.05, 0.55, degree).error;
    const double fine = solve(ball, source, 0.05, 0.28, degree).error;
    EXPECT_LT(fine, coarse / std::pow(2.0, degree - 1.0)) << degree << ' ' << coarse << ' ' << fine;
  }
}

// Two balls a thousandth of their radius apart, bright and dark: in leaves that hold parts of both,
// each part has a patch of its own, and what shines in one does not reach the other.
TEST(LocalSolver, PartsThatNearlyTouchDoNotMix) {
  const double gap = 1e-3, k = 0.05;
  const Vec3 centers[2] = {Vec3(-1.0 - 0.5 * gap, 0.0, 0.0), Vec3(1.0 + 0.5 * gap, 0.0, 0.0)};
  const FormulaBody pair = balls({centers[0], centers[1]}, 1.0, knot_bits);
  const OutsideSource source{Vec3(-1.5, 1.2, 1.5), 1.0};
  const auto bright = [](const Vec3& x) { return x.x() < 0.0; };
  PatchTreeOptions patches;
  patches.deepest = 5;  // leaves a hundred times as wide as the gap
  const auto tree = std::make_shared<PatchTree>(pair.knots, patches);
  const Workers workers(1);
  tree->make_patches(pair.queries, workers);
  for (const Patch& patch : tree->patches())
    for (const Eigen::Index i : patch.knots)
      EXPECT_EQ(bright(pair.knots->positions.col(i)), bright(patch.hubs[0]));
  const LocalBkmSolver solver(tree, pair.queries, source.lambda, k, {}, workers);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(pair.knots->positions.cols());
  for (Eigen::Index i = 0; i < g.size(); ++i)
    if (bright(pair.knots->positions.col(i)))
      g[i] = source.robin(pair.knots->positions.col(i), pair.knots->normals.col(i), k);
  const LocalSolution solution = solver.solve(g, workers);
  EXPECT_TRUE(solution.converged);
  const LocalField field = solver.field(solution, pair.queries);
  Rng rng(6, Stream::check_points, 0);
  for (int i = 0; i < 1000; ++i) {
    Vec3 d;
    do d = Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * 2.0 - Vec3::Ones();
    while (d.norm() > 1.0);
    EXPECT_NEAR(field.value(centers[0] + 0.999 * d), source.value(centers[0] + 0.999 * d), 5e-3);
    EXPECT_NEAR(field.value(centers[1] + 0.999 * d), 0.0, 1e-6);
  }
}

TEST(LocalSolver, BitsDoNotDependOnThreads) {
  const FormulaBody ball = balls({Vec3::Zero()}, 1.0, knot_bits);
  const OutsideSource source{Vec3(0.9, 1.0, 1.4), 1.0};
  const Outcome one = solve(ball, source, 0.05, 0.55, 3, 1);
  const Outcome two = solve(ball, source, 0.05, 0.55, 3, 2);
  EXPECT_EQ(one.solution.beta, two.solution.beta);
}

}  // namespace
}  // namespace knotlight
