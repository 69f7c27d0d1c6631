#include "bkm/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bkm/bkm_cases.h"
#include "bkm/kernels.h"

namespace knotlight {
namespace {

BkmField some_field(int basis_order = 0) {
  const auto s = bkm_cases::sphere(150);
  const RadialFunction gaussian{RadialKind::gaussian, 0.6, 1.0, 1, 1.4, 2.0};
  const RadialFunction waves{RadialKind::nonsingular, 1.0, 1.0, basis_order, 1.4, 2.0};
  BkmBasis basis{point_columns(bkm_cases::cube_grid(6, -1.0, 2.0)), gaussian,
                 point_columns(s.points), waves};
  Eigen::VectorXd alpha(216), beta(150);
  for (int i = 0; i < alpha.size(); ++i) alpha(i) = std::sin(3.0 * i);
  for (int i = 0; i < beta.size(); ++i) beta(i) = std::cos(5.0 * i);
  return {basis, alpha, beta};
}

TEST(Field, ValueIsTheSumOfItsKernels) {
  const BkmField field = some_field();
  const Points centers = bkm_cases::cube_grid(6, -1.0, 2.0);
  const auto s = bkm_cases::sphere(150);
  const Vec3 x(0.21, -0.4, 0.33);
  double u = 0.0, f = 0.0;
  for (Eigen::Index j = 0; j < centers.cols(); ++j) {
    const double r = (x - centers.col(j)).norm();
    u += field.alpha()(j) * gaussian(r, 0.6).value;
    f += field.alpha()(j) * gaussian_helmholtz(r, 0.6, 1.4);
  }
  for (Eigen::Index j = 0; j < 150; ++j)
    u += field.beta()(j) * nonsingular_solution((x - s.points.col(j)).norm(), 1.4, 2.0).value;
  EXPECT_NEAR(field.value(x), u, 1e-12);  // rounding of 366 terms of size 1
  EXPECT_NEAR(field.source(x), f, 1e-11);
}

TEST(Field, ManyValuesHaveTheBitsOfOne) {
  const BkmField field = some_field();
  const Points p = bkm_cases::cube_checks(50, -1.0, 2.0);
  const Eigen::VectorXd u = field.values(p);
  for (Eigen::Index i = 0; i < 50; ++i) EXPECT_EQ(u(i), field.value(p.col(i)));
}

// Fourth of the error at half the step; slack for the next term of the series.
constexpr double rate = 4.0, rate_slack = 0.15;

TEST(Field, GradientByDifferences) {
  const BkmField field = some_field();
  const Vec3 x(0.31, 0.17, -0.52);
  for (int axis = 0; axis < 3; ++axis) {
    const auto error = [&](double h) {
      const Vec3 d = h * Vec3::Unit(axis);
      return (field.value(x + d) - field.value(x - d)) / (2.0 * h) - field.gradient(x)(axis);
    };
    EXPECT_NEAR(error(1e-2) / error(5e-3), rate, rate_slack);
  }
}

// Boundary functions of higher order have a source too.
TEST(Field, ObeysItsOwnSource) {
  for (const int basis_order : {0, 1, 3}) {
    const BkmField field = some_field(basis_order);
    const Vec3 x(-0.31, 0.27, 0.42);
    const auto error = [&](double h) {
      double laplacian = -6.0 * field.value(x);
      for (int axis = 0; axis < 3; ++axis)
        laplacian += field.value(x + h * Vec3::Unit(axis)) + field.value(x - h * Vec3::Unit(axis));
      return laplacian / (h * h) - 1.4 * 1.4 * field.value(x) - field.source(x);
    };
    EXPECT_NEAR(error(2e-2) / error(1e-2), rate, rate_slack) << basis_order;
  }
}

TEST(Field, Robin) {
  const BkmField field = some_field();
  const Vec3 x(0.6, 0.0, 0.8), n(0.6, 0.0, 0.8);
  EXPECT_NEAR(field.robin(x, n, 0.3), field.value(x) + 0.3 * field.gradient(x).dot(n), 1e-12);
}

TEST(Field, EmptyIsZeroAndNaNStays) {
  EXPECT_EQ(BkmField().value(Vec3::Zero()), 0.0);
  EXPECT_EQ(BkmField().source(Vec3::Zero()), 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(some_field().value(Vec3(0.0, nan, 0.0))));
}

}  // namespace
}  // namespace knotlight
