#include "photon/depth_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

// int_0^tau t^k e^-t dt by the recurrence I_k = k I_(k-1) - tau^k e^-tau, which loses digits where
// tau is small beside k; there the series sum_j (-1)^j tau^(k+1+j) / (j! (k+1+j)).
double moment(int k, double tau) {
  if (tau < 3.0) {
    double sum = 0.0;
    double term = std::pow(tau, k + 1);
    for (int j = 0; j < 60; ++j) {
      sum += term / (k + 1 + j);
      term *= -tau / (j + 1);
    }
    return sum;
  }
  double value = -std::expm1(-tau);
  for (int i = 1; i <= k; ++i) value = i * value - std::pow(tau, i) * std::exp(-tau);
  return value;
}

TEST(DepthRule, GaussIsExactForPolynomials) {
  std::vector<DepthPoint> points;
  for (const double tau : {0.01, 0.5, 2.0, 7.0, 25.0, 60.0, 99.0, 150.0}) {
    for (int m = 1; m <= 8; ++m) {
      gauss_depths(tau, m, points);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(m));
      for (int k = 0; k < 2 * m; ++k) {
        double sum = 0.0;
        for (const DepthPoint& p : points) sum += p.weight * std::pow(p.optical_depth, k);
        EXPECT_NEAR(sum / moment(k, tau), 1.0, 1e-9) << tau << ' ' << m << ' ' << k;
      }
    }
  }
}

// The four points of Gauss-Laguerre as tables have them [AS64 tab. 25.9].
TEST(DepthRule, EndlessRayIsGaussLaguerre) {
  std::vector<DepthPoint> points;
  gauss_depths(1e6, 4, points);
  EXPECT_NEAR(points[0].optical_depth, 0.322547689619, 1e-9);
  EXPECT_NEAR(points[3].optical_depth, 9.395070912301, 1e-7);
  EXPECT_NEAR(points[1].weight, 3.57418692438e-1, 1e-9);
}

// Averaged over offsets, the stratified points integrate anything: here e^(-t/2) and a step.
TEST(DepthRule, StratifiedIsUnbiasedOverOffsets) {
  std::vector<DepthPoint> points;
  for (const double tau : {0.3, 4.0, 100.0}) {
    for (const int m : {1, 3}) {
      double smooth = 0.0, step = 0.0, total = 0.0;
      constexpr int offsets = 20'000;
      for (int i = 0; i < offsets; ++i) {
        stratified_depths(tau, m, (i + 0.5) / offsets, points);
        for (const DepthPoint& p : points) {
          smooth += p.weight * std::exp(-0.5 * p.optical_depth) / offsets;
          step += p.optical_depth < 0.2 ? p.weight / offsets : 0.0;
          total += p.weight / offsets;
        }
      }
      EXPECT_NEAR(smooth, -std::expm1(-1.5 * tau) / 1.5, 1e-4);
      EXPECT_NEAR(step, -std::expm1(-0.2), 1e-4);
      EXPECT_NEAR(total, -std::expm1(-tau), 1e-10);
    }
  }
}

}  // namespace
}  // namespace knotlight
