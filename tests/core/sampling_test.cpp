#include "core/sampling.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "core/phase_function.h"
#include "core/rng.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::chi_square_z;
using test::Mean;
using test::z_one_in_a_million;

constexpr int samples = 200'000;

// Draws directions, bins them in (cos theta, phi) over the whole sphere and compares with the
// probability of each bin from the cumulative distribution in cos theta (phi uniform). Bins
// expected to hold fewer than 20 samples are pooled. False-alarm rate 5e-7.
double direction_z(const std::function<Vec3(double, double)>& sample,
                   const std::function<double(double)>& cumulative_in_cosine) {
  constexpr int rows = 20;
  constexpr int columns = 12;
  std::vector<double> counts(rows * columns, 0.0);
  Rng rng(11, Stream::tests, 0);
  for (int i = 0; i < samples; ++i) {
    const double u = rng.uniform();
    const Vec3 w = sample(u, rng.uniform());
    const int row = std::min(rows - 1, static_cast<int>((w.z() + 1.0) * 0.5 * rows));
    const double phi = std::atan2(w.y(), w.x()) / (2.0 * pi) + 0.5;
    const int column = std::min(columns - 1, static_cast<int>(phi * columns));
    counts[static_cast<std::size_t>(row * columns + column)] += 1.0;
  }
  std::vector<double> pooled_counts(1, 0.0);
  std::vector<double> pooled_expected(1, 0.0);
  for (int row = 0; row < rows; ++row) {
    const double p = cumulative_in_cosine(2.0 * (row + 1) / rows - 1.0) -
                     cumulative_in_cosine(2.0 * row / rows - 1.0);
    for (int column = 0; column < columns; ++column) {
      const double expected = samples * p / columns;
      const double count = counts[static_cast<std::size_t>(row * columns + column)];
      if (expected < 20.0) {
        pooled_counts[0] += count;
        pooled_expected[0] += expected;
      } else {
        pooled_counts.push_back(count);
        pooled_expected.push_back(expected);
      }
    }
  }
  if (pooled_expected[0] < 20.0) {
    EXPECT_LT(pooled_counts[0], 60.0);  // nearly empty bins stay nearly empty
    pooled_counts.erase(pooled_counts.begin());
    pooled_expected.erase(pooled_expected.begin());
  }
  return chi_square_z(pooled_counts, pooled_expected);
}

TEST(Sampling, SphereIsUniform) {
  EXPECT_LT(direction_z(sample_sphere, [](double mu) { return 0.5 * (mu + 1.0); }),
            z_one_in_a_million);
}

TEST(Sampling, HemisphereFollowsTheCosine) {
  EXPECT_LT(
      direction_z(sample_cosine_hemisphere, [](double mu) { return mu <= 0.0 ? 0.0 : mu * mu; }),
      z_one_in_a_million);
}

TEST(Sampling, ConeIsUniformWithinItsBorder) {
  constexpr double cos_max = 0.3;
  const auto sample = [](double u, double v) { return sample_cone(u, v, cos_max); };
  EXPECT_LT(direction_z(sample,
                        [](double mu) { return std::max(0.0, (mu - cos_max) / (1.0 - cos_max)); }),
            z_one_in_a_million);
}

TEST(Sampling, NarrowConeKeepsItsDigits) {
  const double cos_max = 1.0 - 1e-14;
  const Vec3 w = sample_cone(0.999999, 0.2, cos_max);
  EXPECT_NEAR(w.head<2>().norm(), std::sqrt(2e-14), 2e-10);
}

// Means of x, y, x^2 + y^2 over the disc are 0, 0, 1/2.
TEST(Sampling, DiscIsUniform) {
  Mean x;
  Mean y;
  Mean r2;
  Rng rng(5, Stream::tests, 0);
  for (int i = 0; i < samples; ++i) {
    const double u = rng.uniform();
    const Eigen::Vector2d p = sample_disc(u, rng.uniform());
    x.add(p.x());
    y.add(p.y());
    r2.add(p.squaredNorm());
    ASSERT_LE(p.squaredNorm(), 1.0 + 1e-12);
  }
  EXPECT_LT(std::abs(x.mean()), z_one_in_a_million * x.standard_error());
  EXPECT_LT(std::abs(y.mean()), z_one_in_a_million * y.standard_error());
  EXPECT_LT(std::abs(r2.mean() - 0.5), z_one_in_a_million * r2.standard_error());
}

// Moments of barycentric coordinates: <b1> = <b2> = 1/3, <b1 b2> = 1/12. False-alarm rate 1e-6
// each.
TEST(Sampling, TriangleIsUniform) {
  Mean b1;
  Mean b2;
  Mean product;
  Rng rng(6, Stream::tests, 0);
  for (int i = 0; i < samples; ++i) {
    const double u = rng.uniform();
    const Eigen::Vector2d b = sample_triangle(u, rng.uniform());
    ASSERT_TRUE(b.x() >= 0.0 && b.y() >= 0.0 && b.sum() <= 1.0 + 1e-12);
    b1.add(b.x());
    b2.add(b.y());
    product.add(b.x() * b.y());
  }
  EXPECT_LT(std::abs(b1.mean() - 1.0 / 3.0), z_one_in_a_million * b1.standard_error());
  EXPECT_LT(std::abs(b2.mean() - 1.0 / 3.0), z_one_in_a_million * b2.standard_error());
  EXPECT_LT(std::abs(product.mean() - 1.0 / 12.0), z_one_in_a_million * product.standard_error());
}

// Exponential: mean 1/sigma, and P(s > 1/sigma) = 1/e.
TEST(Sampling, FreeFlightIsExponential) {
  constexpr double sigma_t = 3.0;
  Mean s;
  Mean beyond;
  Rng rng(8, Stream::tests, 0);
  for (int i = 0; i < samples; ++i) {
    const double flight = sample_free_flight(rng.uniform(), sigma_t);
    s.add(flight);
    beyond.add(flight > 1.0 / sigma_t ? 1.0 : 0.0);
  }
  EXPECT_LT(std::abs(s.mean() - 1.0 / sigma_t), z_one_in_a_million * s.standard_error());
  EXPECT_LT(std::abs(beyond.mean() - std::exp(-1.0)), z_one_in_a_million * beyond.standard_error());
}

// Henyey-Greenstein's cumulative distribution in mu, integrated by hand from its density.
double henyey_greenstein_cumulative(double mu, double g) {
  if (g == 0.0) return 0.5 * (mu + 1.0);
  const double root = std::sqrt(1.0 + g * g - 2.0 * g * mu);
  return (1.0 - g * g) / (2.0 * g) * (1.0 / root - 1.0 / (1.0 + g));
}

class HenyeyGreenstein : public testing::TestWithParam<double> {};

TEST_P(HenyeyGreenstein, SamplesFollowTheDensity) {
  const double g = GetParam();
  const auto sample = [g](double u, double v) {
    return sample_henyey_greenstein(Vec3::UnitZ(), g, u, v);
  };
  EXPECT_LT(direction_z(sample, [g](double mu) { return henyey_greenstein_cumulative(mu, g); }),
            z_one_in_a_million);
}

// Midpoint rule over mu with 2 000 000 cells: integral 1 and mean cosine g to 1e-7.
TEST_P(HenyeyGreenstein, DensityIsNormalisedWithMeanCosineG) {
  const double g = GetParam();
  constexpr int cells = 2'000'000;
  double integral = 0.0;
  double mean = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double mu = 2.0 * (i + 0.5) / cells - 1.0;
    const double p = 2.0 * pi * henyey_greenstein(mu, g) * 2.0 / cells;
    integral += p;
    mean += mu * p;
  }
  EXPECT_NEAR(integral, 1.0, 1e-7);
  EXPECT_NEAR(mean, g, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(MeanCosines, HenyeyGreenstein,
                         testing::Values(-0.6, 0.0, 0.0005, 0.3, 0.8, 0.95));

// Turned relative to the direction before: the mean of w . w' is g (false-alarm rate 1e-6).
TEST(HenyeyGreensteinDirection, TurnsAboutTheOldDirection) {
  const Vec3 w = Vec3(1.0, -2.0, 0.5).normalized();
  Mean cosine;
  Rng rng(9, Stream::tests, 0);
  for (int i = 0; i < samples; ++i) {
    const double u = rng.uniform();
    cosine.add(w.dot(sample_henyey_greenstein(w, 0.7, u, rng.uniform())));
  }
  EXPECT_LT(std::abs(cosine.mean() - 0.7), z_one_in_a_million * cosine.standard_error());
}

}  // namespace
}  // namespace knotlight
