#include "study/multiple_reciprocity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/singular_values.h"

namespace knotlight {
namespace {

// Second differences; their error falls four-fold with half the step.
double helmholtz(const std::function<double(const Vec3&)>& u, const Vec3& x, double lambda,
                 double h) {
  double laplacian = -6.0 * u(x);
  for (int axis = 0; axis < 3; ++axis)
    laplacian += u(x + h * Vec3::Unit(axis)) + u(x - h * Vec3::Unit(axis));
  return laplacian / (h * h) - lambda * lambda * u(x);
}

void expect_power(const std::function<double(const Vec3&)>& u,
                  const std::function<double(const Vec3&)>& power, const Vec3& x, double lambda) {
  const double coarse = helmholtz(u, x, lambda, 2e-2) - power(x);
  const double fine = helmholtz(u, x, lambda, 1e-2) - power(x);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(MultipleReciprocity, PowersOfALampsLight) {
  constexpr double lambda = 1.3;
  const auto at = [](const LampLight& light) {
    return [light](const Vec3& x) { return light.value(x.norm(), x.x() / x.norm()); };
  };
  LampLight light(3.0);
  EXPECT_DOUBLE_EQ(light.value(2.0, 0.8), std::exp(-3.0 * (2.0 - 1.0 / 0.8)) / 4.0);
  for (int m = 0; m < 3; ++m) {
    const LampLight next = light.helmholtz(lambda);
    expect_power(at(light), at(next), {1.6, 0.5, -0.4}, lambda);
    light = next;
  }
}

TEST(MultipleReciprocity, PowersOfAGaussian) {
  constexpr double lambda = 1.3, h = 0.6;
  for (int m = 0; m < 3; ++m) {
    const auto at = [=](int power) {
      return [=](const Vec3& x) { return gaussian_power(power, x.squaredNorm(), h, lambda); };
    };
    expect_power(at(m), at(m + 1), {0.3, 0.5, -0.4}, lambda);
  }
}

// u = (d.x)^2 exp(lambda d.x): L u = (2 + 4 lambda d.x) e, L^2 u = 8 lambda^2 e, L^3 u = 0. Two
// powers of L on the source end it.
TEST(MultipleReciprocity, AChainThatEndsIsExact) {
  constexpr double lambda = 1.5, k = 0.2;
  const Vec3 d = Vec3(1.0, -2.0, 2.0) / 3.0;
  const SurfaceSamples knots = fibonacci_knots(200);
  const Points inside = 0.6 * fibonacci_knots(30).positions;
  const auto wave = [&](const Vec3& x) { return std::exp(lambda * d.dot(x)); };
  Eigen::MatrixXd chain(200, 2);
  Eigen::VectorXd g(200);
  for (Eigen::Index i = 0; i < 200; ++i) {
    const Vec3 x = knots.positions.col(i);
    const double t = d.dot(x), slope = (2.0 * t + lambda * t * t) * wave(x);
    chain(i, 0) = (2.0 + 4.0 * lambda * t) * wave(x);
    chain(i, 1) = 8.0 * lambda * lambda * wave(x);
    g[i] = t * t * wave(x) + k * slope * d.dot(x);
  }
  const BoundaryParticles particles(lambda, k, knots);
  const auto error = [&](Eigen::Index steps) {
    const Eigen::VectorXd u = particles.values(particles.solve(chain.leftCols(steps), g), inside);
    double largest = 0.0;
    for (Eigen::Index i = 0; i < inside.cols(); ++i) {
      const Vec3 x = inside.col(i);
      largest = std::max(largest, std::abs(u[i] - d.dot(x) * d.dot(x) * wave(x)));
    }
    return largest;
  };
  EXPECT_LT(error(2), 1e-5);  // the root of the cut of singular values, a few times over
  EXPECT_GT(error(1), 1e-3);
}

}  // namespace
}  // namespace knotlight
