#include "pipeline/solve_grid.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

Object body(Shape shape) {
  TranslucentMaterial medium;
  medium.sigma_a = Spectrum::Constant(0.1);
  medium.sigma_s = Spectrum::Constant(5.0);
  Object object;
  object.shape = std::move(shape);
  object.material = medium;
  return object;
}

SolverSettings at(double tolerance) {
  SolverSettings settings;
  settings.tolerance = tolerance;
  return settings;
}

// 2 x 2 x 0.1, half a mean free path: by the rule, cells at tolerance 0.3 would be wider than that.
TEST(MakeGrids, CoarseTolerancesStillResolveThinShapes) {
  const Object plate = body(box_mesh(Vec3(-1, -1, 0), Vec3(1, 1, 0.1)));
  const double by_rule = grid_cell_size(plate, 1, at(0.3)).h;
  ASSERT_FALSE(GridGeometry(plate.shape, by_rule, Workers(1)).resolved());
  const ObjectGrids grids = make_grids(plate, 1, at(0.3), Workers(1));
  EXPECT_TRUE(grids.fine->resolved()) << grids.fine->unresolved();
  EXPECT_LT(grids.fine->h(), by_rule);
  EXPECT_GE(grids.fine->h(), grid_cell_size(plate, 1, at(0.01)).h);
}

TEST(MakeGrids, OtherShapesHaveCellsByTheRule) {
  const Object ball = body(Sphere{});
  EXPECT_EQ(make_grids(ball, 1, at(0.04), Workers(1)).fine->h(),
            grid_cell_size(ball, 1, at(0.04)).h);
}

}  // namespace
}  // namespace knotlight
