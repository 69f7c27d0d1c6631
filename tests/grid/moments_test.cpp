#include "grid/moments.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/rng.h"
#include "grid/cell_grid.h"

namespace knotlight {
namespace {

constexpr double rounding = 1e-14;

Vec3 random_point(std::uint64_t i) {
  Rng rng(3, Stream::tests, i);
  const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
  return {x, y, z};
}

// One quadrature point: M_ij = w N_i N_j.
TEST(Moments, OnePointGivesProductsOfShapeFunctions) {
  const Vec3 x = random_point(1);
  Moments m{};
  add_point(m, x, 0.7);
  const ElementVector n = shape_functions(x);
  EXPECT_LT((mass_matrix(m) - 0.7 * n * n.transpose()).cwiseAbs().maxCoeff(), rounding);
  EXPECT_NEAR(total(m), 0.7, rounding);
}

// And K_ij = w grad N_i . grad N_j, against differences of the shape functions (which are linear
// along each axis, so differences over the cell are exact).
TEST(Moments, OnePointGivesProductsOfGradients) {
  const Vec3 x = random_point(2);
  Moments m{};
  add_point(m, x, 1.3);
  Eigen::Matrix<double, 8, 3> gradient;
  for (int a = 0; a < 3; ++a) {
    Vec3 lo = x, hi = x;
    lo[a] = 0.0;
    hi[a] = 1.0;
    gradient.col(a) = shape_functions(hi) - shape_functions(lo);
  }
  EXPECT_LT((stiffness_matrix(m) - 1.3 * gradient * gradient.transpose()).cwiseAbs().maxCoeff(),
            10.0 * rounding);
}

TEST(Moments, WholeCell) {
  const Moments m = full_cell_moments();
  EXPECT_NEAR(total(m), 1.0, rounding);
  EXPECT_NEAR(mass_matrix(m)(0, 0), 1.0 / 27.0, rounding);
  // Known eigenvalues' bounds: one zero (constants), the rest positive.
  const Eigen::VectorXd e =
      Eigen::SelfAdjointEigenSolver<ElementMatrix>(stiffness_matrix(m)).eigenvalues();
  EXPECT_NEAR(e[0], 0.0, 10.0 * rounding);
  EXPECT_GT(e[1], 0.1);
}

// A point of the child is the point (x + corner) / 2 of the parent.
TEST(Moments, ChildToParent) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 x = random_point(10 + static_cast<std::uint64_t>(corner));
    const auto o = corner_offset(corner);
    Moments child{}, expected{}, parent{};
    add_point(child, x, 1.0);
    add_point(expected, 0.5 * (x + Vec3(o[0], o[1], o[2])), 0.125);
    add_to_parent(parent, child, corner, 0.125);
    for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(parent[i], expected[i], rounding);
  }
}

}  // namespace
}  // namespace knotlight
