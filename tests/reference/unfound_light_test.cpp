#include "reference/unfound_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "core/fresnel.h"
#include "reference/path_scenes.h"
#include "reference/refracted_ways.h"

namespace knotlight {
namespace {

using namespace test;

double share(const Traced& scene) {
  return unfound_share(scene.scene(), scene.caster(), 1);
}

TEST(UnfoundLight, NoneWithoutRefraction) {
  EXPECT_EQ(share(Traced({PointLight{Vec3(3, 0, 3), grey(1)}}, {ball(medium(0.1, 1.0))})), 0.0);
  EXPECT_EQ(share(Traced({sky(1.0)}, {ball(medium(0.1, 1.0, 0.0, 1.4))})), 0.0);
}

// A beam straight down into a wide plate of optical thickness b. With R mirrored at each side and a
// = exp(-b) left of each crossing, 1 - a of what enters is scattered at once, and R^k a^k of that
// after k reflections and before the next; what that misses at the sides is nothing for a beam in
// the middle. 20 000 rays, of which 0.64 meet the plate, 1 - R of them enter, and at least 1 - a of
// those are scattered, more than 1400: standard error of the share below sqrt(share / 1400), false
// alarms 1e-6.
TEST(UnfoundLight, MirroredInsideAPlate) {
  const double b = 0.2;
  const double ior = 4.0;
  const Object plate = block(medium(0.0, b, 0.0, ior), Vec3(-1e3, -1e3, -1), Vec3(1e3, 1e3, 0));
  const double once = fresnel_reflectance(1.0, ior) * std::exp(-b);
  const double too_often = std::pow(once, most_mirrors + 1);
  const double found = share(Traced({DirectionalLight{-Vec3::UnitZ(), grey(1)}}, {plate}));
  EXPECT_NEAR(found, too_often, z_one_in_a_million * std::sqrt(too_often / 1400.0));
}

// A ball's mirrors are not searched. Light that meets it at the distance x from its axis is
// refracted along a chord of optical length 2 b cos_t, of which a = exp(-2 b cos_t) is left at each
// end, where R is mirrored along the next such chord: of what enters 1 - a is scattered at once,
// and 1 - a of each (R a)^k later. At least 1 - exp(-b) of 20 000 (1 - R) rays are scattered, more
// than 6000.
TEST(UnfoundLight, MirroredInsideABall) {
  const double b = 0.5;
  const double ior = 1.6;
  double all = 0.0;
  double mirrored = 0.0;
  constexpr int rings = 10'000;
  for (int i = 0; i < rings; ++i) {
    const double x2 = (i + 0.5) / rings;
    const double R = fresnel_reflectance(std::sqrt(1.0 - x2), ior);
    const double a = std::exp(-2.0 * b * std::sqrt(1.0 - x2 / (ior * ior)));
    const double scattered = (1.0 - R) * (1.0 - a) / (1.0 - R * a);
    all += scattered;
    mirrored += R * a * scattered;
  }
  const double expected = mirrored / all;
  const double found =
      share(Traced({DirectionalLight{-Vec3::UnitZ(), grey(1)}}, {ball(medium(0.0, b, 0.0, ior))}));
  EXPECT_NEAR(found, expected, z_one_in_a_million * std::sqrt(expected / 6000.0));
}

// Through a clear ball onto a table, and mirrored onto it.
TEST(UnfoundLight, CausticOnATable) {
  const Traced scene(
      {DirectionalLight{-Vec3::UnitZ(), grey(1)}},
      {ball(medium(1e-6, 0.0, 0.0, 1.4)),
       {"table", quad_mesh(Vec3(0, 0, -1.2), Vec3(3, 0, 0), Vec3(0, 3, 0)), diffuse(0.5)}});
  // The ball stands in 1/11 of the light on the table; of that nearly all gets there.
  EXPECT_NEAR(share(scene), 3.1416 / 36.0, 0.015);
}

TEST(UnfoundLight, RoughSurfacesAreRefused) {
  TranslucentMaterial frosted = medium(0.1, 1.0, 0.0, 1.4);
  frosted.roughness = 0.3;
  const Traced lit({PointLight{Vec3(3, 0, 3), grey(1)}}, {ball(frosted)});
  EXPECT_THROW(refuse_unfindable_lights(lit.scene()), InputError);
  EXPECT_NO_THROW(refuse_unfindable_lights(Traced({sky(1.0)}, {ball(frosted)}).scene()));
}

}  // namespace
}  // namespace knotlight
