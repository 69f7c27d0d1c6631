#include "core/half_space_mode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// int_0^1 mu^k dmu = 1 / (k + 1) up to the degree 2 n - 1, and not beyond.
TEST(HalfSpaceStreams, AreGausss) {
  for (const int n : {1, 2, 7, 32}) {
    const HalfSpaceStreams s = half_space_streams(n);
    for (int k = 0; k < 2 * n; ++k)
      EXPECT_NEAR(s.weight.dot(s.mu.array().pow(k).matrix()), 1.0 / (k + 1), 1e-13)
          << n << " " << k;
  }
  const HalfSpaceStreams two = half_space_streams(2);
  EXPECT_GT(std::abs(two.weight.dot(two.mu.array().pow(4).matrix()) - 0.2), 1e-3);
}

VectorXd powers(double g, int terms) {
  VectorXd moments(terms);
  for (int l = 0; l < terms; ++l) moments[l] = std::pow(g, l);
  return moments;
}

// In the discrete system as it stands, at its own nodes and for albedo 1, all light comes back:
// 2 pi sum_i w_i mu_i rho_0(i, j) = 1 to rounding, single scattering being albedo p_0 / (mu + mu0)
// with p_0 the mean of p over the azimuth.
TEST(HalfSpaceMode, DiscreteSystemConserves) {
  constexpr double pi = std::numbers::pi;
  for (const double g : {0.0, 0.7, -0.6}) {
    const HalfSpaceStreams s = half_space_streams(8);
    const VectorXd moments = powers(g, 16);
    const MatrixXd more = half_space_mode(s, 1.0, moments, 0, s.mu);
    for (int j = 0; j < 8; ++j) {
      double sum = 0.0;
      for (int i = 0; i < 8; ++i) {
        double p = 0.0;
        for (int l = 0; l < 16; ++l) {
          const auto degree = static_cast<unsigned>(l);
          p += (2 * l + 1) * moments[l] * std::legendre(degree, s.mu[i]) *
               std::legendre(degree, -s.mu[j]) / (4.0 * pi);
        }
        sum += 2.0 * pi * s.weight[i] * s.mu[i] * (p + more(i, j)) / (s.mu[i] + s.mu[j]);
      }
      EXPECT_NEAR(sum, 1.0, 1e-6) << g << " " << j;  // the root of a 0 that is 1e-13 by rounding
    }
  }
}

// Modes above 0 have no part in light that comes or leaves along the normal.
TEST(HalfSpaceMode, NothingTurnsAboutTheNormal) {
  const HalfSpaceStreams s = half_space_streams(8);
  const VectorXd mu{{0.0, 0.5, 1.0}};
  for (const int m : {1, 2, 7}) {
    const MatrixXd mode = half_space_mode(s, 0.9, powers(0.8, 16), m, mu);
    EXPECT_EQ(mode.row(2).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_GT(mode(1, 1), 0.0);
  }
}

// A highest mode, with one Legendre function and no odd part, and a single stream.
TEST(HalfSpaceMode, SmallestSystems) {
  const VectorXd mu{{0.2, 0.9}};
  EXPECT_TRUE(half_space_mode(half_space_streams(4), 1.0, powers(0.9, 8), 7, mu).allFinite());
  EXPECT_TRUE(half_space_mode(half_space_streams(1), 1.0, powers(0.0, 2), 0, mu).allFinite());
}

}  // namespace
}  // namespace knotlight
