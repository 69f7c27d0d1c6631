#include "bkm/tikhonov.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bkm/assembly.h"
#include "bkm/bkm_cases.h"
#include "bkm/dense_solver.h"
#include "bkm/radial_functions.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

// Values 1 ... 10^-11 and data s_i + noise: a problem whose best damping can be found by trying.
DataSpectrum noisy(double noise, std::uint64_t stream) {
  constexpr Eigen::Index n = 45;
  DataSpectrum data{Eigen::VectorXd(n), Eigen::VectorXd(n), 0.0, n + 20};
  Rng rng(5, Stream::tests, stream);
  const auto error = [&] { return noise * std::sqrt(12.0) * (rng.uniform() - 0.5); };
  for (Eigen::Index i = 0; i < n; ++i) {
    data.s(i) = std::pow(10.0, -0.25 * static_cast<double>(i));
    data.coefficients(i) = data.s(i) + error();  // the solution is 1 in every direction
  }
  for (int i = 0; i < 20; ++i) data.outside_squared += std::pow(error(), 2);
  return data;
}

// Error of the damped solution in what the data say, which is what GCV estimates.
double predictive_error(const DataSpectrum& data, double mu) {
  const Eigen::ArrayXd s2 = data.s.array().square();
  const Eigen::ArrayXd f = s2 / (s2 + mu * mu);
  return std::sqrt((f * data.coefficients.array() - data.s.array()).square().sum());
}

TEST(Tikhonov, BothRulesComeNearTheBestDamping) {
  for (const double noise : {1e-2, 1e-4, 1e-7})
    for (std::uint64_t stream = 0; stream < 10; ++stream) {
      const DataSpectrum data = noisy(noise, stream);
      double best = std::numeric_limits<double>::infinity();
      for (double mu = 1e-11; mu <= 1.0; mu *= 1.2)
        best = std::min(best, predictive_error(data, mu));
      // Both rules see the noise through one sample of 65 numbers; measured over these fixed
      // streams: at most 1.5 (GCV) and 2.6 (L-curve).
      EXPECT_LT(predictive_error(data, gcv_regulariser(data)), 2.0 * best) << noise;
      EXPECT_LT(predictive_error(data, l_curve_regulariser(data)), 5.0 * best) << noise;
    }
}

// The corner by brute force: (x' y'' - x'' y') / (x'^2 + y'^2)^(3/2) by differences in log mu.
TEST(Tikhonov, CornerIsWhereTheCurveTurnsMost) {
  const DataSpectrum data = noisy(1e-4, 3);
  const auto point = [&](double t) {
    const Eigen::ArrayXd s2 = data.s.array().square();
    const Eigen::ArrayXd f = s2 / (s2 + std::exp(2.0 * t));
    const Eigen::ArrayXd c = data.coefficients.array();
    return Eigen::Vector2d(0.5 * std::log(((1.0 - f) * c).square().sum() + data.outside_squared),
                           0.5 * std::log((f * c / data.s.array()).square().sum()));
  };
  constexpr double h = 1e-2;  // the curve changes over t of 1, and rounding is 1e-16 / h^2
  double corner = 0.0, sharpest = 0.0;
  for (double t = std::log(1e-10); t < 0.0; t += h) {
    const Eigen::Vector2d d1 = (point(t + h) - point(t - h)) / (2.0 * h);
    const Eigen::Vector2d d2 = (point(t + h) - 2.0 * point(t) + point(t - h)) / (h * h);
    const double curvature = (d1.x() * d2.y() - d2.x() * d1.y()) / std::pow(d1.norm(), 3);
    if (curvature > sharpest) {
      sharpest = curvature;
      corner = t;
    }
  }
  constexpr double some_steps = 0.2;  // both look at discrete values of mu, 0.06 apart in log mu
  EXPECT_NEAR(std::log(l_curve_regulariser(data)), corner, some_steps);
}

TEST(Tikhonov, ExactDataAreHardlyDamped) {
  EXPECT_LT(gcv_regulariser(noisy(0.0, 0)), 1e-9);
}

TEST(Tikhonov, NothingToFind) {
  DataSpectrum data = noisy(1e-3, 0);
  data.coefficients.setZero();
  data.outside_squared = 0.0;
  EXPECT_TRUE(std::isfinite(gcv_regulariser(data)));
  EXPECT_TRUE(std::isfinite(l_curve_regulariser(data)));
  data.coefficients(3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(gcv_regulariser(data)));
  EXPECT_TRUE(std::isnan(l_curve_regulariser(data)));
}

// Gaussians of the default width in a ball, data with 1 % of noise: LU turns the noise into
// coefficients of any size.
TEST(Tikhonov, BeatsLuOnANoisySource) {
  const Points at = star_checks(sphere(300));
  const RadialFunction w{RadialKind::gaussian, 1.5, 1.0, 1, 1.0, 2.0};
  const auto f = [](const Vec3& x) { return std::sin(2.0 * x.x()) + x.y() * x.z(); };
  Eigen::VectorXd b(at.cols());
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    Rng rng(6, Stream::tests, static_cast<std::uint64_t>(i));
    b(i) = f(at.col(i)) + 0.01 * std::sqrt(12.0) * (rng.uniform() - 0.5);
  }
  const Points between = 0.9 * sphere(111).points;
  const Eigen::MatrixXd evaluate = source_matrix(between, at, w);
  const auto error = [&](DenseMethod method) {
    const Eigen::VectorXd x = DenseSolver(source_matrix(at, w), {method}).solve(b);
    Eigen::VectorXd e = evaluate * x;
    for (Eigen::Index i = 0; i < e.size(); ++i) e(i) -= f(between.col(i));
    return std::sqrt(e.squaredNorm() / static_cast<double>(e.size()));
  };
  const double by_lu = error(DenseMethod::lu);
  EXPECT_GT(by_lu, 0.05);
  EXPECT_LT(error(DenseMethod::tikhonov_gcv), 0.01);  // less than the noise itself
  EXPECT_LT(error(DenseMethod::tikhonov_l_curve), 0.2 * by_lu);
}

}  // namespace
}  // namespace knotlight
