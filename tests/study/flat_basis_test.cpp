#include "study/flat_basis.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "study/knot_matrix.h"
#include "study/singular_values.h"

namespace knotlight {
namespace {

constexpr double k = 2.0 / 15.0;

double condition(const Eigen::MatrixXd& a) {
  const Eigen::VectorXd s = a.jacobiSvd().singularValues();
  return s[0] / s[s.size() - 1];
}

TEST(KnotMatrix, HasTheClosedFormInEveryArithmetic) {
  const Points x = Vec3(0.3, -0.2, 0.9), y = Vec3(-0.5, 0.1, 0.4), n = Vec3(0.6, 0.0, 0.8);
  const Vec3 d = x.col(0) - y.col(0);
  const double r = d.norm();
  for (const double lambda : {0.1, 2.0, 30.0}) {
    const double value = std::sinh(lambda * r) / (lambda * r);
    const double slope = (std::cosh(lambda * r) - value) / r;
    const double robin = value + k * slope * d.dot(n.col(0)) / r;
    // The reference's own subtraction loses up to (lambda r)^-2 of it.
    const double tolerance = 1e-13 * robin * std::max(1.0, 1.0 / (lambda * lambda));
    const double s = lambda * lambda;
    EXPECT_NEAR(knot_matrix(x, &n, y, s, k)(0, 0), robin, tolerance);
    EXPECT_NEAR(static_cast<double>(knot_matrix(x, &n, y, DoubleDouble(s), k)(0, 0)), robin,
                tolerance);
    EXPECT_NEAR(std::abs(knot_matrix(x, &n, y, std::complex<double>(s), k)(0, 0) - robin), 0.0,
                tolerance);
    // Imaginary lambda: sin(lambda r)/(lambda r).
    EXPECT_NEAR(std::abs(knot_matrix(x, nullptr, y, std::complex<double>(-s), k)(0, 0) -
                         std::sin(lambda * r) / (lambda * r)),
                0.0, 1e-14);
  }
  EXPECT_TRUE(std::isnan(knot_wave(std::nan("")).value));
  EXPECT_EQ(knot_wave(0.0).value, 1.0);
  EXPECT_NEAR(knot_wave(0.0).slope, 1.0 / 3.0, 1e-16);
}

// i_0 = sinh x / x, i_1 = cosh x / x - sinh x / x^2.
TEST(FlatBasis, RatiosOfBesselFunctions) {
  for (const double x : {0.5, 3.0, 40.0})
    EXPECT_NEAR(bessel_ratios(x, 5)[0], 1.0 / std::tanh(x) - 1.0 / x, 1e-14);
  const Eigen::VectorXd small = bessel_ratios(1e-3, 4);
  for (int l = 0; l < 4; ++l) EXPECT_NEAR(small[l], 1e-3 / (2.0 * l + 3.0), 1e-10);
}

// Where double still can, the field of the kernels themselves comes out.
TEST(FlatBasis, SpansWhatTheKernelsSpan) {
  constexpr double lambda = 3.0;
  const SurfaceSamples knots = fibonacci_knots(36);
  const Points checks = 0.7 * fibonacci_knots(20).positions;
  const Eigen::VectorXd g = (2.0 * knots.positions.row(0).array()).exp().transpose();
  const Eigen::MatrixXd kernels =
      knot_matrix(knots.positions, &knots.normals, knots.positions, lambda * lambda, k);
  const Eigen::VectorXd direct =
      knot_matrix(checks, nullptr, knots.positions, lambda * lambda, 0.0) *
      kernels.fullPivLu().solve(g);
  const FlatBasis basis(knots.positions, lambda, 1.0, 20);
  const Eigen::VectorXd u = basis.matrix(checks, nullptr, 0.0) *
                            basis.matrix(knots.positions, &knots.normals, k).fullPivLu().solve(g);
  EXPECT_LT((u - direct).norm(), 1e-10 * direct.norm());
}

// The condition stays as lambda goes to 0, where the kernels' own grows without bound.
TEST(FlatBasis, HasACondition) {
  const SurfaceSamples knots = fibonacci_knots(64);
  const auto of = [&](double lambda) {
    return condition(
        FlatBasis(knots.positions, lambda, 1.0, 12).matrix(knots.positions, &knots.normals, k));
  };
  EXPECT_LT(of(1e-6), 1e3);
  EXPECT_NEAR(of(1e-6) / of(1e-3), 1.0, 1e-3);
  EXPECT_GT(condition(knot_matrix(knots.positions, &knots.normals, knots.positions, 1e-6, k)),
            1e15);
}

}  // namespace
}  // namespace knotlight
