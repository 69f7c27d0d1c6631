#include "grid/multigrid.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "grid/grid_cases.h"

namespace knotlight {
namespace {

using namespace grid_cases;

Eigen::VectorXd random_vector(Eigen::Index size, std::uint64_t stream) {
  Rng rng(6, Stream::tests, stream);
  Eigen::VectorXd x(size);
  for (double& v : x) v = rng.uniform() - 0.5;
  return x;
}

// Conjugate gradients need a symmetric positive definite preconditioner.
TEST(Multigrid, PreconditionerIsSymmetricPositive) {
  const auto g = geometry(torus(1.0, 0.4, 40, 20), 0.08);
  const Multigrid m(g->levels(), {0.5, 0.1});
  auto work = m.workspace();
  const Eigen::VectorXd x = random_vector(m.finest().size(), 1);
  const Eigen::VectorXd y = random_vector(m.finest().size(), 2);
  Eigen::VectorXd Bx, By;
  m.precondition(x, Bx, work);
  m.precondition(y, By, work);
  EXPECT_NEAR(y.dot(Bx) / x.dot(By), 1.0, 1e-9);
  EXPECT_GT(x.dot(Bx), 0.0);
}

// The number of steps does not grow with the number of cells, for any medium.
TEST(Multigrid, StepsDoNotGrow) {
  for (const double h : {0.12, 0.06, 0.03}) {
    const auto g = geometry(Sphere{}, h);
    for (const double lambda : {0.0, 30.0})
      for (const double k : {0.01, 3.0}) {
        const Multigrid m(g->levels(), {lambda, k});
        const auto result = solve(m, random_vector(m.finest().size(), 3), 1e-8, 60);
        EXPECT_TRUE(result.converged);
        EXPECT_LE(result.iterations, 20) << lambda << " " << k << " " << h;
      }
  }
}

TEST(Multigrid, BadDataEnd) {
  const auto g = geometry(Sphere{}, 0.2);
  const Multigrid m(g->levels(), {1.0, 0.1});
  Eigen::VectorXd b = Eigen::VectorXd::Zero(m.finest().size());
  EXPECT_TRUE(solve(m, b, 1e-9, 10).converged);
  b[5] = std::nan("");
  EXPECT_FALSE(solve(m, b, 1e-9, 10).converged);
}

}  // namespace
}  // namespace knotlight
