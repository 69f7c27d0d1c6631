#include "photon/surface_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "support/statistics.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// A ball and a box: on each the share of its area, evenly over the box's faces and the ball's
// octants. Chi-square of 14 cells with 100 000 points: a false alarm once in 2e6.
TEST(SurfaceSampler, PointsByArea) {
  const Shape ball = Sphere{Vec3(1, 2, 3), 0.7};
  const Shape box = box_mesh(Vec3(-4, -3, -2), Vec3(-3, -1, 1));
  const SurfaceSampler sampler({{5, &ball}, {2, &box}});
  const double area = 4.0 * pi * 0.49 + 22.0;
  EXPECT_NEAR(sampler.area(), area, 1e-12);
  constexpr int n = 100'000;
  std::vector<double> counts(14, 0.0), expected(14, n * 4.0 * pi * 0.49 / 8.0 / area);
  const double faces[3] = {6.0, 3.0, 2.0};
  for (std::size_t i = 8; i < 14; ++i) expected[i] = n * faces[(i - 8) / 2] / area;
  Rng rng(3, Stream::tests, 0);
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform();
    const SurfaceSampler::Point p = sampler(u, rng.uniform());
    const Vec3& x = p.surface.position;
    const Vec3& normal = p.surface.normal;
    if (p.object == 5) {
      EXPECT_NEAR((x - Vec3(1, 2, 3)).norm(), 0.7, 1e-12);
      EXPECT_NEAR((x - Vec3(1, 2, 3)).dot(normal), 0.7, 1e-12);
      counts[(normal.x() > 0 ? 1U : 0U) + (normal.y() > 0 ? 2U : 0U) +
             (normal.z() > 0 ? 4U : 0U)] += 1;
    } else {
      ASSERT_EQ(p.object, 2U);
      int axis = 0;
      normal.cwiseAbs().maxCoeff(&axis);
      const double face = normal[axis] > 0 ? bounds(box).hi[axis] : bounds(box).lo[axis];
      EXPECT_NEAR(x[axis], face, 1e-12);
      counts[8 + 2 * static_cast<std::size_t>(axis) + (normal[axis] > 0 ? 1U : 0U)] += 1;
    }
  }
  EXPECT_LT(test::chi_square_z(counts, expected), test::z_one_in_a_million);
}

// The mean position of even points on an uneven mesh is the area's centroid: here a sphere's
// centre.
TEST(SurfaceSampler, EvenOverTriangles) {
  const Shape mesh = test::icosphere(2);
  const SurfaceSampler sampler({{0, &mesh}});
  Vec3 mean = Vec3::Zero();
  constexpr int side = 300;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      mean += sampler((i + 0.5) / side, (j + 0.5) / side).surface.position / (side * side);
  EXPECT_LT(mean.norm(), 0.01);
  EXPECT_EQ(SurfaceSampler({}).area(), 0.0);
}

}  // namespace
}  // namespace knotlight
