#include "photon/irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "photon_scenes.h"

namespace knotlight {
namespace {

using namespace testing_scenes;
using std::numbers::pi;

double entered_power(const Scene& scene, std::size_t count, int threads = 2) {
  const auto caster = caster_of(scene);
  double sum = 0.0;
  for (const IrradianceSample& s :
       sample_irradiances(scene, *caster, 0, 0, count, 4, 1, 0, Workers(threads)))
    sum += s.entered * s.area;
  return sum;
}

// A ball of radius 2 in a beam of irradiance 3 takes 3 pi R^2, less what Fresnel reflects:
// int_0^1 2 mu (1 - F(mu)) dmu of it, here by the midpoint rule. 20 000 strata err by 1e-3.
TEST(Irradiance, BallInABeam) {
  for (const double ior : {1.0, 1.5}) {
    const Scene scene =
        scene_of({parallel_light(Vec3(1, -1, 2), 3.0)},
                 {translucent(Sphere{Vec3(1, 1, 1), 2.0}, {1.0, 9.0, 0.0, ior, 0.0})});
    double passed = 0.0;
    constexpr int steps = 10'000;
    for (int i = 0; i < steps; ++i) {
      const double mu = (i + 0.5) / steps;
      passed += 2.0 * mu * (1.0 - fresnel_reflectance(mu, ior)) / steps;
    }
    EXPECT_NEAR(entered_power(scene, 20'000) / (3.0 * pi * 4.0 * passed), 1.0, 3e-3) << ior;
  }
}

// Under a sky of radiance L every point of a convex surface gets pi L, sample by sample.
TEST(Irradiance, UnderASkyItIsExact) {
  const Scene scene =
      scene_of({sky(0.7)}, {translucent(Sphere{Vec3::Zero(), 1.0}, {1.0, 9.0, 0.0, 1.0, 0.0})});
  const auto caster = caster_of(scene);
  for (const IrradianceSample& s :
       sample_irradiances(scene, *caster, 0, 0, 500, 4, 1, 0, Workers(1)))
    ASSERT_NEAR(s.entered, 0.7 * pi, 1e-12);
  EXPECT_NEAR(entered_power(scene, 500), 0.7 * pi * 4.0 * pi, 1e-9);
}

// Independent sets for independent replicates, the same bits for any number of threads.
TEST(Irradiance, ReplicatesAndThreads) {
  const Scene scene = scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                               {translucent(torus_mesh(32, 16), {1.0, 9.0, 0.0, 1.0, 0.0})});
  const auto caster = caster_of(scene);
  const auto a = sample_irradiances(scene, *caster, 0, 0, 1000, 4, 1, 0, Workers(1));
  const auto b = sample_irradiances(scene, *caster, 0, 0, 1000, 4, 1, 0, Workers(3));
  const auto c = sample_irradiances(scene, *caster, 0, 0, 1000, 4, 1, 1, Workers(1));
  EXPECT_EQ(a[17].surface.position, b[17].surface.position);
  EXPECT_EQ(a[500].entered, b[500].entered);
  EXPECT_NE(a[17].surface.position, c[17].surface.position);
}

}  // namespace
}  // namespace knotlight
