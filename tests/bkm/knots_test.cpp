#include "bkm/knots.h"

#include <gtest/gtest.h>

#include "bkm/bkm_cases.h"

namespace knotlight {
namespace {

TEST(Knots, LieAtTheirDepths) {
  const auto s = bkm_cases::sphere(60);
  const InteriorKnots knots =
      interior_knots(s.points, s.normals, {0.1, 0.25}, [](const Vec3&) { return true; });
  ASSERT_EQ(knots.points.cols(), 120);
  EXPECT_EQ(knots.dropped, 0u);
  for (Eigen::Index i = 0; i < 120; ++i)
    EXPECT_NEAR(knots.points.col(i).norm(), i < 60 ? 0.9 : 0.75, 1e-14);  // rounding
}

// In a plate of thickness 1, candidates 1.5 below one face lie outside the other; the order of the
// rest is kept.
TEST(Knots, OutsideIsDroppedAndCounted) {
  Points p(3, 3), n(3, 3);
  p << 0, 1, 2, 0, 0, 0, 1, 1, 1;
  n << 0, 0, 0, 0, 0, 0, 1, 1, 1;
  const auto inside = [](const Vec3& x) { return x.z() > 0.0 && x.z() < 1.0 && x.x() != 1.0; };
  const InteriorKnots knots = interior_knots(p, n, {0.5, 1.5}, inside);
  EXPECT_EQ(knots.dropped, 4u);
  ASSERT_EQ(knots.points.cols(), 2);
  EXPECT_EQ(Vec3(knots.points.col(0)), Vec3(0.0, 0.0, 0.5));
  EXPECT_EQ(Vec3(knots.points.col(1)), Vec3(2.0, 0.0, 0.5));
}

TEST(Knots, MeanSpacing) {
  EXPECT_DOUBLE_EQ(mean_knot_spacing(24.0, 600), 0.2);
}

}  // namespace
}  // namespace knotlight
