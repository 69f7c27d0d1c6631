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
  for (const std::size_t at : {0, 1}) {
    const Eigen::VectorXd x = random_vector(m.matrix(at).size(), 1);
    const Eigen::VectorXd y = random_vector(m.matrix(at).size(), 2);
    Eigen::VectorXd Bx, By;
    m.precondition(at, x, Bx, work);
    m.precondition(at, y, By, work);
    // Up to the rounding of float, 6e-8 in each of the sums.
    EXPECT_NEAR(y.dot(Bx) / x.dot(By), 1.0, 2e-5);
    EXPECT_GT(x.dot(Bx), 0.0);
  }
}

// The number of steps does not grow with the number of cells, for any medium.
TEST(Multigrid, StepsDoNotGrow) {
  for (const double h : {0.12, 0.06, 0.03}) {
    const auto g = geometry(Sphere{}, h);
    for (const double lambda : {0.0, 30.0})
      for (const double k : {0.01, 3.0}) {
        const Multigrid m(g->levels(), {lambda, k});
        for (const std::size_t at : {0, 1}) {
          const auto result = solve(m, at, random_vector(m.matrix(at).size(), 3), {}, 1e-8, 60);
          EXPECT_TRUE(result.converged);
          EXPECT_LE(result.iterations, 20) << lambda << " " << k << " " << h << " " << at;
        }
      }
  }
}

// Conjugate gradients begin where they are told to.
TEST(Multigrid, StartsFromAGuess) {
  const auto g = geometry(Sphere{}, 0.1);
  const Multigrid m(g->levels(), {1.0, 0.1});
  const Eigen::VectorXd b = random_vector(m.matrix(0).size(), 4);
  const auto from_zero = solve(m, 0, b, {}, 1e-9, 60);
  const auto warm = solve(m, 0, b, from_zero.x + 1e-3 * random_vector(b.size(), 5), 1e-9, 60);
  EXPECT_TRUE(warm.converged);
  EXPECT_LT(warm.iterations, from_zero.iterations);
  EXPECT_LT((warm.x - from_zero.x).norm(), 1e-7 * from_zero.x.norm());
  EXPECT_EQ(solve(m, 0, b, warm.x, 1e-8, 60).iterations, 0);
}

// The coarse functions lie among the fine ones: constants stay, and the two ways are transposed.
TEST(Multigrid, BetweenTheGrids) {
  const auto g = geometry(Sphere{}, 0.1);
  const Multigrid m(g->levels(), {1.0, 0.1});
  const Eigen::VectorXd x = random_vector(m.matrix(0).size(), 6);
  const Eigen::VectorXd y = random_vector(m.matrix(1).size(), 7);
  EXPECT_NEAR(x.dot(m.prolonged(y)), m.restricted(x).dot(y), 1e-12 * x.norm() * y.norm());
  EXPECT_LT((m.prolonged(Eigen::VectorXd::Ones(y.size())).array() - 1.0).abs().maxCoeff(), 1e-15);
  // Without penalty and with all moments added up, energies agree.
  const Multigrid plain(g->levels(), {1.0, 0.1, 0.0});
  const Eigen::VectorXd Py = plain.prolonged(y);
  Eigen::VectorXd APy, Ay;
  plain.matrix(0).apply(Py, APy);
  plain.matrix(1).apply(y, Ay);
  EXPECT_NEAR(Py.dot(APy) / y.dot(Ay), 1.0, 1e-12);
}

TEST(Multigrid, BadDataEnd) {
  const auto g = geometry(Sphere{}, 0.2);
  const Multigrid m(g->levels(), {1.0, 0.1});
  Eigen::VectorXd b = Eigen::VectorXd::Zero(m.matrix(0).size());
  EXPECT_TRUE(solve(m, 0, b, {}, 1e-9, 10).converged);
  b[5] = std::nan("");
  EXPECT_FALSE(solve(m, 0, b, {}, 1e-9, 10).converged);
}

}  // namespace
}  // namespace knotlight
