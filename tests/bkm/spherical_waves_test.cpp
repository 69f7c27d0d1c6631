// Spherical waves against closed forms, differences, and the equation they are to solve.
#include "bkm/spherical_waves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"

namespace knotlight {
namespace {

Vec3 random_point(Rng& rng, double radius) {
  Vec3 x;
  do x = 2.0 * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - Vec3::Ones();
  while (x.norm() > 1.0);
  return radius * x;
}

// Degree 0 is sinh(x)/x, degree 1 the derivative of it times a direction cosine.
TEST(SphericalWaves, TheFirstFourAreClosedForms) {
  Rng rng(1, Stream::check_points, 0);
  for (const double lambda : {0.0, 1e-4, 0.7, 20.0}) {
    const double rho = 1.3;
    const SphericalWaves waves(1, lambda, rho);
    for (int i = 0; i < 20; ++i) {
      const Vec3 x = random_point(rng, rho);
      const double r = x.norm();
      Eigen::VectorXd row(4);
      waves.values(x, row);
      const auto i0 = [&](double s) {
        return lambda * s > 1e-3 ? std::sinh(lambda * s) / (lambda * s)
                                 : 1.0 + lambda * lambda * s * s / 6.0;
      };
      // i_1(x) = (x cosh x - sinh x)/x^2, here over x/3; its series where that cancels.
      const auto i1 = [&](double s) {
        const double t = lambda * s;
        return t > 1e-2 ? 3.0 * (t * std::cosh(t) - std::sinh(t)) / (t * t * t)
                        : 1.0 + t * t / 10.0 + t * t * t * t / 280.0;
      };
      EXPECT_NEAR(row[0], i0(r) / i0(rho), 1e-12 * std::abs(row[0]) + 1e-15);
      const double radial = std::sqrt(3.0) * i1(r) / i1(rho) / rho;
      // Columns 1, 2, 3: m = 0 (z), then the cosine (x) and the sine (y).
      EXPECT_NEAR(row[1], radial * x.z(), 1e-9);
      EXPECT_NEAR(row[2], radial * x.x(), 1e-9);
      EXPECT_NEAR(row[3], radial * x.y(), 1e-9);
    }
  }
}

// Rms over a sphere of radius rho is 1 for each, and different ones are orthogonal: a product rule
// of Gauss points is exact, a spiral of many points nearly so (error measured 1e-5 at 20 000).
TEST(SphericalWaves, AreOrthonormalOnTheirSphere) {
  const int degree = 5;
  const SphericalWaves waves(degree, 2.0, 0.8);
  const int n = 20'000;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(waves.size(), waves.size());
  Eigen::VectorXd row(waves.size());
  for (int i = 0; i < n; ++i) {
    const double z = (2.0 * i + 1.0) / n - 1.0;
    const double phi = 2.399963229728653 * i;
    const double s = std::sqrt(1.0 - z * z);
    waves.values(0.8 * Vec3(s * std::cos(phi), s * std::sin(phi), z), row);
    gram += row * row.transpose() / n;
  }
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(waves.size(), waves.size())).cwiseAbs().maxCoeff(),
            2e-3);
}

TEST(SphericalWaves, SolveTheEquation) {
  Rng rng(2, Stream::check_points, 0);
  const double rho = 0.5;
  for (const double lambda : {0.0, 3.0}) {
    const SphericalWaves waves(6, lambda, rho);
    for (int i = 0; i < 10; ++i) {
      const Vec3 x = random_point(rng, 0.9 * rho);
      const double h = 1e-3 * rho;
      Eigen::VectorXd middle(waves.size()), side(waves.size());
      waves.values(x, middle);
      Eigen::VectorXd laplacian = -6.0 * middle;
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
          waves.values(x + sign * h * Vec3::Unit(axis), side);
          laplacian += side;
        }
      laplacian /= h * h;
      // Second differences of functions of size 1, degree 6: h^2/12 of fourth derivatives.
      EXPECT_LT((laplacian - lambda * lambda * middle).cwiseAbs().maxCoeff() * rho * rho, 5e-3);
    }
  }
}

TEST(SphericalWaves, RobinValuesAreThoseOfDifferences) {
  Rng rng(3, Stream::check_points, 0);
  const SphericalWaves waves(5, 1.7, 0.9);
  for (int i = 0; i < 20; ++i) {
    const Vec3 x = random_point(rng, 0.8);
    const Vec3 n = random_point(rng, 1.0).normalized();
    const double k = 0.3, h = 1e-5;
    Eigen::VectorXd robin(waves.size()), here(waves.size()), ahead(waves.size()),
        behind(waves.size());
    waves.robin(x, n, k, robin);
    waves.values(x, here);
    waves.values(x + h * n, ahead);
    waves.values(x - h * n, behind);
    EXPECT_LT((robin - here - k * (ahead - behind) / (2.0 * h)).cwiseAbs().maxCoeff(), 1e-8);
    const Eigen::VectorXd beta = Eigen::VectorXd::LinSpaced(waves.size(), -1.0, 1.0);
    EXPECT_NEAR(waves.sum(x, beta), here.dot(beta), 1e-13);
    EXPECT_NEAR(waves.sum(x, beta) + k * waves.gradient(x, beta).dot(n), robin.dot(beta), 1e-12);
  }
}

}  // namespace
}  // namespace knotlight
