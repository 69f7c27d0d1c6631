#include "stability/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/test_meshes.h"

namespace knotlight {
namespace {

constexpr double rounding = 1e-12;

TEST(Shapes, AreClosedAndOutward) {
  const TriangleMesh tip = tetrahedron_mesh({0.1, 0.2, 0.3}, Vec3(1, 2, 2) / 3.0, 1.5);
  for (const TriangleMesh& mesh :
       {ellipsoid_mesh({1, 0, 0}, {1.0, 0.02, 0.02}, 0.2), tip, star_mesh(),
        both(star_mesh(), ellipsoid_mesh({5, 0, 0}, Vec3::Ones(), 0.3))}) {
    EXPECT_EQ(test::open_edges(mesh), 0U);
    EXPECT_GT(signed_volume(mesh), 0.0);
  }
}

TEST(Shapes, HaveTheirVolumes) {
  constexpr double facets = 0.02;  // chords instead of arcs
  EXPECT_NEAR(signed_volume(ellipsoid_mesh(Vec3::Zero(), {1.0, 0.5, 0.2}, 0.15)) /
                  (4.0 / 3.0 * std::numbers::pi * 0.1),
              1.0, facets);
  // Regular, edge a = h sqrt(3/2): a^3 / (6 sqrt 2).
  const double edge = 1.5 * std::sqrt(1.5);
  EXPECT_NEAR(signed_volume(tetrahedron_mesh(Vec3::Zero(), Vec3::UnitY(), 1.5)),
              edge * edge * edge / (6.0 * std::sqrt(2.0)), rounding);
  EXPECT_NEAR(signed_volume(star_mesh()), 4.0, rounding);  // half of its cube
}

TEST(Shapes, BothKeepsBoth) {
  const TriangleMesh a = star_mesh(), b = tetrahedron_mesh(Vec3::Zero(), Vec3::UnitZ(), 1.0);
  const TriangleMesh sum = both(a, b);
  EXPECT_EQ(sum.triangles.size(), a.triangles.size() + b.triangles.size());
  EXPECT_NEAR(signed_volume(sum), signed_volume(a) + signed_volume(b), rounding);
}

}  // namespace
}  // namespace knotlight
