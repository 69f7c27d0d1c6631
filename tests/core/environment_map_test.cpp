#include "core/environment_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "core/sampling.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;  // a few dozen operations on numbers around 1

Vec3 direction(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

// The direction of the centre of a pixel.
Vec3 pixel_center(int column, int row, int width, int height) {
  return direction(pi * (row + 0.5) / height, -pi + 2.0 * pi * (column + 0.5) / width);
}

std::vector<Spectrum> random_pixels(int count) {
  Rng rng(1, Stream::tests, 0);
  std::vector<Spectrum> pixels;
  for (int i = 0; i < count; ++i) {
    // Most pixels black, few bright: what skies with a sun look like.
    const double brightness = rng.uniform() < 0.7 ? 0.0 : 1.0 / (0.05 + rng.uniform());
    pixels.push_back(brightness * Spectrum(rng.uniform(), rng.uniform(), rng.uniform()));
  }
  return pixels;
}

TEST(EnvironmentMap, PixelCentresAreThePixels) {
  const int width = 8, height = 4;
  const std::vector<Spectrum> pixels = random_pixels(width * height);
  const EnvironmentMap map(width, height, pixels);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Spectrum found = map.radiance(pixel_center(column, row, width, height));
      EXPECT_NEAR((found - pixels[row * width + column]).abs().maxCoeff(), 0.0, 1e-11);
    }
  }
}

// Four columns: edges of the picture at -x, then the quarters -x..-y, -y..+x, +x..+y, +y..-x.
TEST(EnvironmentMap, LayoutIsTheStatedOne) {
  std::vector<Spectrum> pixels;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; ++column) {
      pixels.push_back(Spectrum(column, row, 0));
    }
  }
  const EnvironmentMap map(4, 2, pixels);
  EXPECT_NEAR(map.radiance(Vec3(-1, -1, 0).normalized())[0], 0, rounding);
  EXPECT_NEAR(map.radiance(Vec3(1, -1, 0).normalized())[0], 1, rounding);
  EXPECT_NEAR(map.radiance(Vec3(1, 1, 0).normalized())[0], 2, rounding);
  EXPECT_NEAR(map.radiance(Vec3(-1, 1, 0).normalized())[0], 3, rounding);
  // +x is half way between columns 1 and 2; -x, where the ends meet, between 3 and 0.
  EXPECT_NEAR(map.radiance(Vec3(1, 0, 0))[0], 1.5, rounding);
  EXPECT_NEAR(map.radiance(Vec3(-1, 0.0, 0))[0], 1.5, rounding);
  EXPECT_NEAR(map.radiance(Vec3(-1, -0.0, 0))[0], 1.5, rounding);
  EXPECT_NEAR(map.radiance(Vec3(0, 0, 1))[1], 0, rounding);
  EXPECT_NEAR(map.radiance(Vec3(0, 0, -1))[1], 1, rounding);
  EXPECT_NEAR(map.radiance(Vec3(1, 0, 0))[1], 0.5, rounding);
}

TEST(EnvironmentMap, SamplesHaveTheStatedDensity) {
  const int width = 8, height = 5;
  const EnvironmentMap map(width, height, random_pixels(width * height));
  const int n = 200'000;
  std::vector<double> counts(width * height, 0.0), expected(width * height, 0.0);
  Rng rng(2, Stream::tests, 1);
  int differing = 0;
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform(), v = rng.uniform();
    const EnvironmentMap::Sample sample = map.sample(u, v);
    ASSERT_NEAR(sample.direction.norm(), 1.0, rounding);
    const int row = static_cast<int>(std::acos(sample.direction.z()) / pi * height);
    const int column = static_cast<int>(
        (std::atan2(sample.direction.y(), sample.direction.x()) + pi) / (2 * pi) * width);
    const int pixel = row * width + column;
    counts[pixel] += 1.0;
    const double solid_angle =
        2 * pi / width * (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
    expected[pixel] = n * sample.pdf * solid_angle;
    // Across the border between two pixels rounding may decide.
    differing += std::abs(map.pdf(sample.direction) - sample.pdf) > 1e-9 * sample.pdf ? 1 : 0;
  }
  EXPECT_LE(differing, 1);
  double total = 0.0;
  for (const double e : expected) total += e;
  EXPECT_NEAR(total / n, 1.0, 1e-9);  // every pixel that shines was met; the densities add up to 1
  std::erase(counts, 0.0);            // the others are black to both
  std::erase(expected, 0.0);
  // 200 000 samples in up to 40 cells; false alarms 5e-7.
  EXPECT_LT(test::chi_square_z(counts, expected), test::z_one_in_a_million);
}

// The mean of radiance / pdf is the integral over the sphere, here against directions spread
// evenly. It is low if a direction that shines can't be chosen (black neighbours of a bright pixel
// shine by interpolation).
TEST(EnvironmentMap, SamplesIntegrateTheInterpolatedMap) {
  const int width = 8, height = 5;
  const EnvironmentMap map(width, height, random_pixels(width * height));
  const int n = 200'000;
  test::Mean by_density, by_sphere;
  Rng rng(3, Stream::tests, 2);
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform(), v = rng.uniform();
    const EnvironmentMap::Sample sample = map.sample(u, v);
    by_density.add(map.radiance(sample.direction)[0] / sample.pdf);
    const double u2 = rng.uniform(), v2 = rng.uniform();
    by_sphere.add(map.radiance(sample_sphere(u2, v2))[0] * 4.0 * pi);
  }
  // Both carry a standard error of about 0.4 %; the limit is for the difference at a rate of 1e-6.
  const double error = std::hypot(by_density.standard_error(), by_sphere.standard_error());
  EXPECT_LT(error / by_sphere.mean(), 1e-2);
  EXPECT_NEAR(by_density.mean(), by_sphere.mean(), test::z_one_in_a_million * error);
}

TEST(EnvironmentMap, UniformAndBlackMapsAreSampledUniformly) {
  for (const double radiance : {0.0, 2.0}) {
    const EnvironmentMap map(6, 3, std::vector<Spectrum>(18, Spectrum::Constant(radiance)));
    for (const double u : {0.0, 0.3, 0.999999}) {
      for (const double v : {0.0, 0.6, 0.999999}) {
        EXPECT_NEAR(map.sample(u, v).pdf, 1.0 / (4.0 * pi), rounding);
        EXPECT_NEAR(map.sample(u, v).direction.z(), 1.0 - 2.0 * v, rounding);
      }
    }
  }
}

TEST(EnvironmentMap, OnePixelIsAMap) {
  const EnvironmentMap map(1, 1, {Spectrum(1, 2, 3)});
  EXPECT_NEAR(map.radiance(Vec3(0.6, 0, -0.8))[2], 3.0, rounding);
  EXPECT_NEAR(map.sample(0.2, 0.7).pdf, 1.0 / (4.0 * pi), rounding);
}

}  // namespace
}  // namespace knotlight
