#include "reference/path_surfaces.h"

#include <gtest/gtest.h>

#include "reference/path_scenes.h"

namespace knotlight {
namespace {

using namespace test;

constexpr double tolerance = 1e-5;  // surfaces may lie that far apart and count as touching

PathRay outside(const Vec3& position, const Vec3& direction) {
  PathRay ray;
  ray.position = position;
  ray.direction = direction.normalized();
  return ray;
}

PathRay inside(const Vec3& position, const Vec3& direction, std::uint32_t medium) {
  PathRay ray = outside(position, direction);
  ray.inside = true;
  ray.medium = medium;
  return ray;
}

TEST(PathSurfaces, BallAndBlockFromOutsideAndInside) {
  for (const bool round : {true, false}) {
    const Traced scene(
        {}, {round ? ball(medium(0, 1)) : block(medium(0, 1), Vec3(-1, -1, -1), Vec3(1, 1, 1))});
    const PathSurfaces surfaces(scene.scene(), scene.caster());
    const auto in = surfaces.next(outside(Vec3(0.1, 0.2, 4), -Vec3::UnitZ()));
    ASSERT_TRUE(in);
    EXPECT_GT(in->normal.z(), 0.9);
    EXPECT_NEAR(in->t, 4.0 - in->position.z(), tolerance);
    const auto out = surfaces.next(inside(Vec3(0.1, 0.2, 0.3), Vec3::UnitZ(), 0));
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->t, out->position.z() - 0.3, tolerance);
    EXPECT_FALSE(surfaces.next(inside(Vec3(0.1, 0.2, 0.3), Vec3::UnitZ(), 0), 0.5));
    EXPECT_FALSE(surfaces.next(outside(Vec3(0.1, 0.2, 4), Vec3::UnitZ())));
    PathRay leaving = outside(out->position, Vec3::UnitZ());
    leaving.surface = 0;
    EXPECT_FALSE(surfaces.next(leaving));
    EXPECT_EQ(surfaces.medium_around(Vec3(0.1, 0.2, 0.3)), 0U);
    EXPECT_FALSE(surfaces.medium_around(Vec3(0.1, 0.2, 2.0)));
  }
}

// Out of one and, in the same place, into the other.
TEST(PathSurfaces, BlocksInTouch) {
  const Traced scene({}, {block(medium(0, 1), Vec3(-1, -1, -1), Vec3(0, 1, 1)),
                          block(medium(0, 1), Vec3(0, -1, -1), Vec3(1, 1, 1))});
  const PathSurfaces surfaces(scene.scene(), scene.caster());
  const auto out = surfaces.next(inside(Vec3(-0.5, 0.1, 0.2), Vec3::UnitX(), 0));
  ASSERT_TRUE(out);
  EXPECT_EQ(out->object, 0U);
  EXPECT_NEAR(out->t, 0.5, tolerance);
  PathRay between = outside(out->position, Vec3::UnitX());
  between.surface = 0;
  const auto in = surfaces.next(between);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->object, 1U);
  EXPECT_LT(in->normal.x(), 0.0);
  EXPECT_EQ(in->t, 0.0);
}

// A diffuse object in the medium ends the way; one that lies against it is met by what has left.
TEST(PathSurfaces, DiffuseObjectsInsideAndAgainst) {
  const Traced scene(
      {}, {block(medium(0, 1), Vec3(-1, -1, 0), Vec3(1, 1, 1)),
           ball(diffuse(0.5), 0.2, Vec3(0, 0, 0.5)),
           {"table", quad_mesh(Vec3::Zero(), Vec3(3, 0, 0), Vec3(0, 3, 0)), diffuse(0.5)}});
  const PathSurfaces surfaces(scene.scene(), scene.caster());
  const auto core = surfaces.next(inside(Vec3(0.01, 0.02, 0.9), -Vec3::UnitZ(), 0));
  ASSERT_TRUE(core);
  EXPECT_EQ(core->object, 1U);
  const auto bottom = surfaces.next(inside(Vec3(0.6, 0.5, 0.9), -Vec3::UnitZ(), 0));
  ASSERT_TRUE(bottom);
  EXPECT_EQ(bottom->object, 0U);
  PathRay left = outside(bottom->position, -Vec3::UnitZ());
  left.surface = 0;
  const auto table = surfaces.next(left);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->object, 2U);
  PathRay back = outside(table->position, Vec3::UnitZ());
  back.surface = 2;
  const auto again = surfaces.next(back);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->object, 0U);
  // From below, the table is in front of the block.
  const auto below = surfaces.next(outside(Vec3(0.6, 0.5, -1), Vec3::UnitZ()));
  ASSERT_TRUE(below);
  EXPECT_EQ(below->object, 2U);
}

}  // namespace
}  // namespace knotlight
