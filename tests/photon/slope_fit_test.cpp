// The fitted slope on photons laid out as an exact exponential, and its noise against its spread.
#include "photon/slope_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

// A grid of weights exp(b.u) in the unit ball, or in the half of it below a plane through the
// centre: the sum of the carried weights is the number of points, whatever b.
LocalPhotons grid(const Vec3& b, bool half, Vec3& centroid) {
  LocalPhotons photons;
  centroid.setZero();
  constexpr int n = 12;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vec3 u = (2.0 * Vec3(i + 0.5, j + 0.5, k + 0.5) / n).array() - 1.0;
        if (u.norm() >= 1.0 || (half && u.z() > 0.0)) continue;
        photons.offsets.push_back(u);
        photons.weights.push_back(std::exp(b.dot(u)));
        centroid += u;
      }
  centroid /= static_cast<double>(photons.offsets.size());
  return photons;
}

TEST(SlopeFit, ExponentialsAreExact) {
  // The Newton steps end at a centroid within 1e-4, times the slope.
  constexpr double tolerance = 1e-3;
  for (const bool half : {false, true})
    for (const Vec3& b : {Vec3(0, 0, 0), Vec3(0.5, -0.3, 0.8), Vec3(0, 2, 3), Vec3(1, 0, -3)}) {
      Vec3 centroid;
      LocalPhotons photons = grid(b, half, centroid);
      carry_along_slope(photons, centroid);
      double sum = 0.0;
      for (const double w : photons.weights) sum += w;
      const double count = static_cast<double>(photons.weights.size());
      EXPECT_NEAR(sum / count, 1.0, tolerance) << b.transpose() << half;
    }
}

TEST(SlopeFit, FewOrOneSidedPhotonsStayAsTheyAre) {
  LocalPhotons few{{Vec3(0.1, 0.2, 0.3), Vec3(-0.5, 0, 0)}, {1.0, 2.0}};
  EXPECT_DOUBLE_EQ(carry_along_slope(few, Vec3::Zero()), std::sqrt(5.0) / 3.0);
  EXPECT_EQ(few.weights, (std::vector<double>{1.0, 2.0}));
  LocalPhotons beside;
  for (int i = 0; i < 50; ++i) {
    beside.offsets.emplace_back(0.5 + 0.001 * (i % 7), 0.1 * (i % 5), 0.1 * (i % 3));
    beside.weights.push_back(1.0);
  }
  carry_along_slope(beside, Vec3::Zero());
  EXPECT_EQ(beside.weights, std::vector<double>(50, 1.0));
}

// 400 draws of 300 photons uniform in a half ball: the spread of the sum is as stated within
// 5 standard errors of a variance, sqrt(2/399) each, and 10 % for a fit that is linear in the noise
// to first order only.
TEST(SlopeFit, StatedErrorIsTheSpread) {
  constexpr int draws = 400;
  double mean = 0.0, squares = 0.0, stated = 0.0;
  for (int d = 0; d < draws; ++d) {
    Rng rng(11, Stream::tests, static_cast<std::uint64_t>(d));
    LocalPhotons photons;
    for (int i = 0; i < 300; ++i) {
      const double radius = std::cbrt(rng.uniform());
      const double u = rng.uniform();
      Vec3 p = radius * sample_sphere(u, rng.uniform());
      p.z() = -std::abs(p.z());
      photons.offsets.push_back(p);
      photons.weights.push_back(1.0);
    }
    const double error = carry_along_slope(photons, Vec3(0, 0, -0.375));
    double sum = 0.0;
    for (const double w : photons.weights) sum += w / 300.0;
    mean += sum / draws;
    squares += sum * sum / draws;
    stated += error * error / draws;
  }
  // The number itself is fixed here, not a Poisson variable: its part 1/300 is in what is stated.
  const double spread = squares / (mean * mean) - 1.0 + 1.0 / 300.0;
  EXPECT_NEAR(spread / stated, 1.0, 5.0 * std::sqrt(2.0 / (draws - 1)) + 0.1);
}

}  // namespace
}  // namespace knotlight
