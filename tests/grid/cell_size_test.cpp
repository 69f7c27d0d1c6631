#include "grid/cell_size.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

TEST(CellSize, Rule) {
  const Shape ball = Sphere{};
  EXPECT_DOUBLE_EQ(cell_size_for(ball, 5.0, 5.0, 0.01, 100'000'000).h,
                   2.0 / 64.0);  // the object decides
  EXPECT_DOUBLE_EQ(cell_size_for(ball, 30.0, 30.0, 0.01, 100'000'000).h,
                   0.5 / 30.0);  // the medium decides
  EXPECT_DOUBLE_EQ(cell_size_for(ball, 40.0, 40.0, 0.04, 100'000'000).h,
                   1.0 / 40.0);  // second order
  EXPECT_DOUBLE_EQ(cell_size_for(ball, 30.0, 150.0, 0.01, 100'000'000).h, 0.75 / 150.0);  // g = 0.8
  EXPECT_DOUBLE_EQ(cell_size_for(ball, 40.0, 40.0, 0.5, 100'000'000).h,
                   coarsest_cells / 40.0);  // light's first scattering is to be seen
  EXPECT_FALSE(cell_size_for(ball, 30.0, 30.0, 0.01, 100'000'000).limited());
}

TEST(CellSize, FinerTolerancesMayCostMore) {
  EXPECT_EQ(cell_budget(0.05), 2'000'000u);
  EXPECT_EQ(cell_budget(0.01), 2'000'000u);
  EXPECT_EQ(cell_budget(0.004), 5'000'000u);
  EXPECT_EQ(cell_budget(1e-5), 8'000'000u);
}

TEST(CellSize, Budget) {
  const CellSize ball = cell_size_for(Sphere{}, 1000.0, 1000.0, 0.01, 100'000);
  EXPECT_TRUE(ball.limited());
  EXPECT_NEAR(volume(Sphere{}) / std::pow(ball.h, 3), 100'000, 1.0);
  EXPECT_DOUBLE_EQ(ball.h_sigma_tr, 1000.0 * ball.h);
  // A thin diagonal shape: the bounding box is what costs.
  TriangleMesh rod = box_mesh(Vec3(-1, -0.01, -0.01), Vec3(1, 0.01, 0.01));
  for (Vec3& v : rod.vertices) v = Eigen::AngleAxisd(0.9, Vec3(1, -1, 1).normalized()) * v;
  const CellSize thin = cell_size_for(rod, 1e4, 1e4, 0.01, 100'000);
  const Bounds box = bounds(rod);
  EXPECT_LE((box.hi - box.lo).prod() / std::pow(thin.h, 3), 800'001.0);
}

}  // namespace
}  // namespace knotlight
