// The closed forms against the transport equation they solve and against known paths.
#include "reference/first_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/not_finite.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-14;  // relative; a dozen operations

TEST(FirstLight, PathsOfASphere) {
  const PathLength path = path_in_sphere(Vec3(1, 2, 3), 2.0);
  EXPECT_NEAR(path(Vec3(1, 2, 3), Vec3::UnitX(), infinity), 2.0, rounding);
  EXPECT_NEAR(path(Vec3(1, 2, 1), Vec3::UnitZ(), infinity), 4.0, 4.0 * rounding);
  EXPECT_NEAR(path(Vec3(1, 2, 1), -Vec3::UnitZ(), infinity), 0.0, rounding);
  EXPECT_NEAR(path(Vec3(1, 2, 3), Vec3(0.6, 0, 0.8), 0.7), 0.7, rounding);
  // A chord at distance 1.2 from the centre, from its middle: half its length is 1.6.
  EXPECT_NEAR(path(Vec3(1, 3.2, 3), Vec3::UnitX(), infinity), 1.6, rounding);
  EXPECT_NEAR(path(Vec3(-9, 3.2, 3), Vec3::UnitX(), infinity), 3.2, 20.0 * rounding);
  EXPECT_EQ(path(Vec3(-9, 4.2, 3), Vec3::UnitX(), infinity), 0.0);
}

TEST(FirstLight, PathsOfASlab) {
  const PathLength path = path_in_slab(-3.0, 0.0);
  EXPECT_NEAR(path(Vec3(5, 6, -1), Vec3(0.6, 0, 0.8), infinity), 1.25, rounding);
  EXPECT_NEAR(path(Vec3(5, 6, -1), Vec3(0, 0.6, -0.8), infinity), 2.5, rounding);
  EXPECT_NEAR(path(Vec3(5, 6, 1), -Vec3::UnitZ(), infinity), 3.0, rounding);
  EXPECT_EQ(path(Vec3(5, 6, 1), Vec3::UnitZ(), infinity), 0.0);
  EXPECT_EQ(path(Vec3(5, 6, -1), Vec3::UnitX(), 7.0), 7.0);
}

TEST(FirstLight, BeerLambertInASlab) {
  const Medium m{0.2, 1.8, 0.8, 1.0, 0.0};
  const Vec3 d(0.6, 0, -0.8);
  const UnscatteredLight light =
      first_light_directional(Vec3(3, 4, -0.4), d, 5.0, m, path_in_slab(-3, 0));
  EXPECT_NEAR(light.U_ri, 5.0 * std::exp(-1.0) / (4.0 * pi), rounding);
  EXPECT_LT((light.Q_ri - 0.8 * 1.8 * 5.0 * std::exp(-1.0) * d).norm(), 10.0 * rounding);
}

// div F_ri = -4 pi sigma_t U_ri: by central differences, whose error is of the order
// (sigma_t h)^2/6 = 7e-7 of the value, of curved rays and paths up to twenty times that. Fails
// without the inverse square or with a wrong path.
TEST(FirstLight, FluxLosesWhatIsExtinguished) {
  constexpr double h = 1e-3;
  constexpr double truncation = 3e-5;
  const Medium m{0.2, 1.8, 0.8, 1.0, 0.0};
  const PathLength path = path_in_sphere(Vec3::Zero(), 1.0);
  const auto distant = [&](const Vec3& x) {
    return first_light_directional(x, Vec3(0.48, 0.6, -0.64), 2.0, m, path);
  };
  const auto point = [&](const Vec3& x) {
    return first_light_point(x, Vec3(1.5, -1, 1), 2.0, m, path);
  };
  const auto inside = [&](const Vec3& x) {
    return first_light_point(x, Vec3(0.1, 0.2, -0.3), 2.0, m, path);
  };
  for (const Vec3& x : {Vec3(0.3, 0.2, 0.1), Vec3(-0.5, 0.4, 0.3), Vec3(0.1, -0.7, -0.2)}) {
    for (const std::function<UnscatteredLight(const Vec3&)>& light :
         {std::function<UnscatteredLight(const Vec3&)>(distant),
          std::function<UnscatteredLight(const Vec3&)>(point),
          std::function<UnscatteredLight(const Vec3&)>(inside)}) {
      double divergence = 0.0;
      for (int i = 0; i < 3; ++i)
        divergence +=
            (light(x + h * Vec3::Unit(i)).Q_ri[i] - light(x - h * Vec3::Unit(i)).Q_ri[i]) /
            (2.0 * h);
      const double known = -4.0 * pi * m.g * m.sigma_s * m.sigma_t() * light(x).U_ri;
      EXPECT_NEAR(divergence / known, 1.0, truncation);
    }
  }
}

}  // namespace
}  // namespace knotlight
