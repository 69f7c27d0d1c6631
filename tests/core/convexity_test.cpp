#include "core/convexity.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

TEST(Convexity, ConvexBodies) {
  EXPECT_TRUE(is_convex(Sphere{}));
  EXPECT_TRUE(is_convex(box_mesh(Vec3(0, 0, 0), Vec3(1, 2, 0.1))));
  EXPECT_TRUE(is_convex(refine(box_mesh(Vec3(0, 0, 0), Vec3(1, 2, 0.1)), 0.05)));
}

// A box with a dent, and two boxes in one mesh: each bends outwards everywhere, but together light
// passes from one to the other.
TEST(Convexity, LightCanComeBack) {
  TriangleMesh dented = refine(box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1)), 0.3);
  Vec3* middle = nullptr;
  for (Vec3& v : dented.vertices)
    if (v.z() == 1.0 && (v - Vec3(0.5, 0.5, 1.0)).norm() < 0.01) middle = &v;
  ASSERT_NE(middle, nullptr);
  middle->z() = 0.9;
  EXPECT_FALSE(is_convex(dented));

  TriangleMesh two = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
  const TriangleMesh other = box_mesh(Vec3(2, 0, 0), Vec3(3, 1, 1));
  const auto offset = static_cast<std::uint32_t>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    two.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  EXPECT_FALSE(is_convex(two));
}

}  // namespace
}  // namespace knotlight
