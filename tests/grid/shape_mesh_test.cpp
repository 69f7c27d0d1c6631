#include "grid/shape_mesh.h"

#include <gtest/gtest.h>

#include "grid/grid_cases.h"

namespace knotlight {
namespace {

using namespace grid_cases;

TEST(ShapeMesh, SphereKeepsItsVolume) {
  const Sphere ball{Vec3(1, 2, 3), 0.7};
  for (const double h : {0.5, 0.05}) {
    const CellGrid grid = grid_around(Shape(ball), h);
    const TriangleMesh mesh = mesh_in_cells(Shape(ball), grid);
    EXPECT_NEAR(signed_volume(mesh) * h * h * h / volume(Shape(ball)), 1.0, 1e-12);
    for (const Vec3& v : mesh.vertices)
      EXPECT_NEAR((grid.origin + h * v - ball.center).norm(), 0.7, 0.1 * h);
  }
}

// A free layer on each side, and no cell too many for whole multiples of h.
TEST(ShapeMesh, GridAround) {
  const CellGrid grid = grid_around(Shape(box_mesh(Vec3(0, 0, 0), Vec3(1, 0.5, 0.33))), 0.1);
  EXPECT_EQ(grid.n, (std::array<int, 3>{12, 7, 6}));
  EXPECT_LE((grid.origin - Vec3(-0.1, -0.1, -0.1)).maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace knotlight
