#include "reference/unfound_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "core/fresnel.h"
#include "reference/path_scenes.h"

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
// = exp(-b) left of each crossing, 1 - a of what enters is scattered at once, and (1 - a) (R a +
// R^2 a^2 + ...) after mirroring; what that misses at the sides is nothing for a beam in the
// middle. 20 000 rays: standard error of the share below sqrt(share / 6000).
TEST(UnfoundLight, MirroredInsideAPlate) {
  const double b = 0.5;
  const Object plate = block(medium(0.0, b, 0.0, 1.6), Vec3(-1e3, -1e3, -1), Vec3(1e3, 1e3, 0));
  const double R = fresnel_reflectance(1.0, 1.6);
  const double mirrored = R * std::exp(-b);
  const double found = share(Traced({DirectionalLight{-Vec3::UnitZ(), grey(1)}}, {plate}));
  EXPECT_NEAR(found, mirrored, 5.0 * std::sqrt(mirrored / 6000.0));
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
