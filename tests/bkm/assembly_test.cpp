#include "bkm/assembly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bkm/bkm_cases.h"
#include "bkm/kernels.h"

namespace knotlight {
namespace {

constexpr double relative = 1e-13;  // some roundings of vector against scalar exponentials

TEST(Assembly, SourceMatrixAgreesWithBruteForce) {
  const Points p = bkm_cases::cube_checks(150, 0.0, 2.0);  // more than one batch
  const double c = 0.7, lambda = 1.3;
  RadialFunction w;
  w.c = c;
  w.lambda = lambda;
  const Eigen::MatrixXd phi = source_matrix(p, w);
  ASSERT_EQ(phi.rows(), 150);
  ASSERT_EQ(phi.cols(), 150);
  const double size = 6.0 / (c * c) + lambda * lambda;
  for (Eigen::Index i = 0; i < 150; ++i)
    for (Eigen::Index j = 0; j < 150; ++j) {
      const double r = (p.col(i) - p.col(j)).norm();
      EXPECT_NEAR(phi(i, j), gaussian_helmholtz(r, c, lambda), relative * size);
    }
  EXPECT_EQ(phi, phi.transpose());  // to the last bit: it is then solved as a symmetric matrix
  EXPECT_LT((source_matrix(p, p.leftCols(40), w) - phi.leftCols(40)).cwiseAbs().maxCoeff(),
            relative * size);
}

// [V09 6.13] with the chain rule written out; on the diagonal the derivative is 0.
TEST(Assembly, RobinMatrixAgreesWithBruteForce) {
  const auto s = bkm_cases::ellipsoid(140, Vec3(1.0, 1.5, 0.6));
  const double lambda = 2.1, k = 0.4, R = 3.0;
  const RadialFunction w{RadialKind::nonsingular, 1.0, 1.0, 0, lambda, R};
  const Eigen::MatrixXd robin = robin_matrix(s.points, s.normals, s.points, k, w);
  for (Eigen::Index i = 0; i < 140; ++i)
    for (Eigen::Index j = 0; j < 140; ++j) {
      const Vec3 d = s.points.col(i) - s.points.col(j);
      const RadialValue v = nonsingular_solution(d.norm(), lambda, R);
      const double normal = i == j ? 0.0 : d.dot(s.normals.col(i)) / d.norm();
      EXPECT_NEAR(robin(i, j), v.value + k * v.derivative * normal, relative);
    }
}

TEST(Assembly, SameBitsForAnyNumberOfThreads) {
  const auto s = bkm_cases::sphere(333);
  const RadialFunction w{RadialKind::thin_plate, 0.8, 1.0, 1, 1.3, 2.0};
  const AssemblyOptions one, three{DistancePrecision::double_precision, Workers(3)};
  EXPECT_EQ(source_matrix(s.points, w, one), source_matrix(s.points, w, three));
  EXPECT_EQ(robin_matrix(s.points, s.normals, s.points, 0.2, w, one),
            robin_matrix(s.points, s.normals, s.points, 0.2, w, three));
}

TEST(Assembly, TinyEntriesBecomeZeroRelativeToTheLargest) {
  Eigen::MatrixXd a(2, 2);
  a << 1e10, -1e-21, 9e-21, -2e-20;
  zero_tiny_entries(a);
  EXPECT_EQ(a(0, 1), 0.0);
  EXPECT_EQ(a(1, 0), 0.0);
  EXPECT_EQ(a(1, 1), -2e-20);
  a(0, 1) = std::numeric_limits<double>::quiet_NaN();
  zero_tiny_entries(a);
  EXPECT_TRUE(std::isnan(a(0, 1)));
}

}  // namespace
}  // namespace knotlight
