#include "photon/volume_emission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photon_scenes.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using namespace testing_scenes;
using std::numbers::pi;
using Orders = TracerOptions::Orders;

// Objects by power, evenly over each: the ball has mean squared radius 3/5 and the mean direction
// is none. 20 000 photons; each check raises a false alarm once in a million.
TEST(VolumeEmission, FillsTheBodiesEvenly) {
  const Medium glowing{1.0, 1.0, 0.0, 1.0, 2.0};
  Medium brighter = glowing;
  brighter.emission = 6.0;
  const Scene scene = scene_of({}, {translucent(Sphere{Vec3(4, 0, 0), 1.0}, brighter),
                                    translucent(Sphere{Vec3(9, 0, 0), 1.0}, {1, 1, 0, 1, 0}),
                                    translucent(torus_mesh(40, 20), glowing)});
  const auto caster = caster_of(scene);
  const VolumeEmission emission(scene, *caster, 0);
  const double of_ball = 6.0 * 4.0 / 3.0 * pi;
  const double of_torus = 2.0 * volume(scene.objects[2].shape);
  EXPECT_NEAR(emission.power(), of_ball + of_torus, 1e-9);
  Rng rng(1, Stream::tests, 0);
  test::Mean in_ball, radius2, up;
  for (int i = 0; i < 20'000; ++i) {
    const VolumeEmission::Photon p = emission.sample(rng);
    ASSERT_TRUE(caster->inside(p.photon.origin, p.object));
    EXPECT_EQ(p.photon.power, emission.power());
    in_ball.add(p.object == 0 ? 1.0 : 0.0);
    up.add(p.photon.direction.dot(Vec3(0.6, 0, 0.8)));
    if (p.object == 0) radius2.add((p.photon.origin - Vec3(4, 0, 0)).squaredNorm());
  }
  const auto expect = [](const test::Mean& m, double exact) {
    EXPECT_NEAR(m.mean(), exact, test::z_one_in_a_million * m.standard_error());
  };
  expect(in_ball, of_ball / emission.power());
  expect(radius2, 0.6);
  expect(up, 0.0);
}

// A clear glowing ball of radius 1 and a black one of radius R at distance D: of what a point at
// distance d from the black one's centre emits (1 - sqrt(1 - (R/d)^2)) / 2 arrives, here integrated
// over the glowing ball by the midpoint rule. It arrives as light that was emitted, which an audit
// of the lights' light (Orders::all) does not hold.
TEST(VolumeEmission, LightsOtherObjects) {
  constexpr double R = 0.8, D = 2.5;
  const Scene scene = scene_of({}, {translucent(Sphere{Vec3::Zero(), 1.0}, {1e-9, 0, 0, 1, 1.0}),
                                    translucent(Sphere{Vec3(0, 0, D), R}, {1000, 0, 0, 1, 0.0})});
  double arriving = 0.0;
  constexpr int steps = 400;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double r = (i + 0.5) / steps;
      const double mu = 2.0 * (j + 0.5) / steps - 1.0;
      const double d2 = r * r + D * D - 2.0 * r * D * mu;
      arriving +=
          2.0 * pi * r * r / steps * 2.0 / steps * 0.5 * (1.0 - std::sqrt(1.0 - R * R / d2));
    }
  const TraceResult r = trace(scene, Orders::returned, 100'000, true);
  double power = 0.0;
  for (const VolumePhoton& p : r.photons[1]) power += p.power;
  const double share = arriving / (4.0 / 3.0 * pi);
  const double error = std::sqrt(share * (1.0 - share) / 100'000) / share;
  EXPECT_NEAR(power / arriving, 1.0, sigmas * error + 1e-5);
  EXPECT_TRUE(r.photons[0].empty());
  EXPECT_EQ(trace(scene, Orders::all, 1000).audit[1].incident, 0.0);
}

}  // namespace
}  // namespace knotlight
