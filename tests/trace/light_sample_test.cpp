#include "trace/light_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

TEST(LightSample, PointAndDirectionalLightsAreExact) {
  Rng rng(1, Stream::tests, 0);
  const auto point = sample_light(PointLight{Vec3(0, 0, 2), Spectrum(8, 4, 2)}, Vec3::Zero(), rng);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->distance, 2.0, 1e-15);
  EXPECT_NEAR((point->to_light - Vec3::UnitZ()).norm(), 0.0, 1e-15);
  EXPECT_NEAR(point->irradiance[0], 2.0, 1e-15);
  const auto beam =
      sample_light(DirectionalLight{-Vec3::UnitX(), Spectrum::Constant(3.0)}, Vec3::Zero(), rng);
  ASSERT_TRUE(beam);
  EXPECT_TRUE(std::isinf(beam->distance));
  EXPECT_EQ(beam->to_light, Vec3::UnitX());
  EXPECT_EQ(beam->irradiance[1], 3.0);
  EXPECT_FALSE(sample_light(EnvironmentLight{}, Vec3::Zero(), rng));
}

// int cos dw over a square of half-edge a seen from distance d on its axis, the flux through a
// plane that faces it: 4 * 2 / pi form factors of a corner, E = L 2 (a/s) 2 atan(a/s), s^2 = a^2 +
// d^2. 40 000 samples, standard error taken from them, a false alarm at 5 of them once in two
// million.
TEST(LightSample, AreaLightHasItsIrradianceAndABack) {
  const double a = 0.7, d = 1.3;
  const AreaLight lamp{Vec3(0, 0, d), Vec3(a, 0, 0), Vec3(0, -a, 0), Spectrum::Constant(2.0)};
  Rng rng(2, Stream::tests, 0);
  constexpr int n = 40'000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const auto sample = sample_light(lamp, Vec3::Zero(), rng);
    ASSERT_TRUE(sample);
    const double e = sample->irradiance[0] * sample->to_light.z();
    sum += e / n;
    squares += e * e / n;
  }
  const double s = std::hypot(a, d);
  const double expected = 2.0 * 4.0 * (a / s) * std::atan(a / s);
  EXPECT_NEAR(sum, expected, 5.0 * std::sqrt((squares - sum * sum) / n));
  EXPECT_FALSE(sample_light(lamp, Vec3(0, 0, 2 * d), rng));
}

// A map that is the same everywhere: mean intensity 4 pi L over 4 pi.
TEST(LightSample, EnvironmentMapHasItsMeanIntensity) {
  const auto map =
      std::make_shared<EnvironmentMap>(8, 4, std::vector<Spectrum>(32, Spectrum::Constant(1.5)));
  const EnvironmentLight sky{Spectrum::Constant(2.0), map};
  Rng rng(3, Stream::tests, 0);
  constexpr int n = 20'000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double U = sample_light(sky, Vec3::Zero(), rng)->irradiance[2] / (4.0 * pi);
    sum += U / n;
    squares += U * U / n;
  }
  // 5 standard errors and the rounding of a map that is sampled exactly.
  EXPECT_NEAR(sum, 3.0, 1e-9 + 5.0 * std::sqrt(std::max(0.0, squares - sum * sum) / n));
}

}  // namespace
}  // namespace knotlight
