#include "study/volume_cells.h"

#include <gtest/gtest.h>

#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

double mean_square_x(const VolumeCells& cells) {
  return cells.volumes.dot(cells.centers.row(0).array().square().matrix().transpose());
}

// Volumes add up, second moments come with an error of second order (here h^2/12 of each cell).
TEST(VolumeCells, StandForTheBody) {
  const VolumeCells cube = cells_of_cube(8, 2.0), ball = cells_of_ball(12);
  EXPECT_NEAR(cube.volumes.sum(), 8.0, 1e-12);
  EXPECT_NEAR(ball.volumes.sum(), 4.0 * pi / 3.0, 1e-12);
  EXPECT_NEAR(mean_square_x(cube), 32.0 / 3.0, 8.0 * 0.0625 / 12.0 + 1e-12);
  EXPECT_NEAR(mean_square_x(ball) / (4.0 * pi / 15.0), 1.0, 0.01);
  EXPECT_LT((ball.centers * ball.volumes).norm(), 1e-3);
  EXPECT_NEAR(4.0 * pi / 3.0 * std::pow(cube.radius(), 3), 0.25 * 0.25 * 0.25, 1e-12);
}

TEST(VolumeCells, KnowTheNearestSurface) {
  const VolumeCells cube = cells_of_cube(6, 3.0), ball = cells_of_ball(4);
  for (Eigen::Index i = 0; i < cube.size(); ++i) {
    const Vec3 x = cube.centers.col(i);
    const double depth = std::min(x.minCoeff(), 3.0 - x.maxCoeff());
    const Vec3 expected = x + depth * cube.nearest.normals.col(i);
    EXPECT_NEAR((cube.nearest.positions.col(i) - expected).norm(), 0.0, 1e-12);
    EXPECT_GT((x - Vec3::Constant(1.5)).dot(cube.nearest.normals.col(i)), 0.0);
  }
  for (Eigen::Index i = 0; i < ball.size(); ++i) {
    const Vec3 x = ball.centers.col(i);
    EXPECT_NEAR((ball.nearest.positions.col(i) - x.normalized()).norm(), 0.0, 1e-12);
    EXPECT_EQ(ball.nearest.positions.col(i), ball.nearest.normals.col(i));
  }
}

TEST(VolumeCells, ChosenOnesKeepTheirs) {
  const VolumeCells all = cells_of_ball(3);
  const Eigen::Array<bool, Eigen::Dynamic, 1> keep = all.centers.row(2).array() > 0.3;
  const VolumeCells chosen = chosen_cells(all, keep);
  ASSERT_EQ(chosen.size(), keep.count());
  EXPECT_GT(chosen.size(), 0);
  for (Eigen::Index i = 0; i < chosen.size(); ++i) {
    EXPECT_GT(chosen.centers(2, i), 0.3);
    EXPECT_NEAR((chosen.nearest.normals.col(i) - chosen.centers.col(i).normalized()).norm(), 0.0,
                1e-12);
  }
}

TEST(SpreadDirections, AreEvenlySpread) {
  const Points d = spread_directions(500);
  EXPECT_NEAR((d.colwise().norm().array() - 1.0).abs().maxCoeff(), 0.0, 1e-12);
  // 500 caps of equal area have the radius 0.089; of a spiral [G10] neighbours are no nearer.
  for (Eigen::Index i = 0; i < d.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_GT((d.col(i) - d.col(j)).norm(), 0.089);
}

}  // namespace
}  // namespace knotlight
