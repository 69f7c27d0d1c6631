#include "grid/scan_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grid/grid_cases.h"
#include "grid/shape_mesh.h"

namespace knotlight {
namespace {

using namespace grid_cases;

// Inside lengths of all lines against the mesh's volume: the midpoint rule over the cross-section
// is the only error.
TEST(ScanLines, VolumeOfATiltedTorus) {
  const Shape shape = torus(1.0, 0.4, 60, 30);
  const CellGrid grid = grid_around(shape, 0.1);
  const TriangleMesh mesh = mesh_in_cells(shape, grid);
  for (int axis = 0; axis < 3; ++axis) {
    const ScanLines lines(mesh, grid.n, axis);
    EXPECT_EQ(lines.unsure_lines(), 0U);
    double sum = 0.0;
    for (int j = 0; j < lines_per_cell * grid.n[static_cast<std::size_t>((axis + 2) % 3)]; ++j)
      for (int i = 0; i < lines_per_cell * grid.n[static_cast<std::size_t>((axis + 1) % 3)]; ++i)
        for (const Interval& part : lines.line(i, j)) sum += part.end - part.begin;
    EXPECT_NEAR(sum / 16.0 / signed_volume(mesh), 1.0, 2e-3);
  }
}

// Ends lie on the sphere, up to the facets' h^2 / 8R; a line has at most one part.
TEST(ScanLines, SphereEnds) {
  const Shape shape = Sphere{Vec3(0.1, 0.2, 0.3), 1.0};
  const CellGrid grid = grid_around(shape, 0.125);
  const ScanLines lines(mesh_in_cells(shape, grid), grid.n, 2);
  const Vec3 center = grid.to_cells(Vec3(0.1, 0.2, 0.3));
  int met = 0;
  for (int j = 0; j < 4 * grid.n[1]; ++j)
    for (int i = 0; i < 4 * grid.n[0]; ++i)
      for (const Interval& part : lines.line(i, j)) {
        ++met;
        for (const double t : {part.begin, part.end})
          EXPECT_NEAR((Vec3((i + 0.5) / 4, (j + 0.5) / 4, t) - center).norm(), 8.0, 1.0 / 64.0);
      }
  EXPECT_NEAR(met, pi * 64 * 16, 0.01 * pi * 64 * 16);
}

// Lines that run exactly through edges and corners: each is met once, or reported.
TEST(ScanLines, LinesThroughEdgesAndCorners) {
  TriangleMesh mesh = box_mesh(Vec3(1.125, 1.125, 1.0), Vec3(3.125, 3.125, 3.0));
  mesh = refine(mesh, 0.6);
  const ScanLines lines(mesh, {5, 5, 5}, 2);
  EXPECT_LE(lines.unsure_lines(), 32U);
  for (int j = 6; j < 12; ++j)
    for (int i = 6; i < 12; ++i) {
      ASSERT_EQ(lines.line(i, j).size(), 1U) << i << " " << j;
      EXPECT_NEAR(lines.line(i, j)[0].begin, 1.0, 1e-12);
      EXPECT_NEAR(lines.line(i, j)[0].end, 3.0, 1e-12);
    }
}

// A mesh with a hole is reported.
TEST(ScanLines, HoleIsCounted) {
  TriangleMesh mesh = box_mesh(Vec3(1, 1, 1), Vec3(3, 3, 3));
  mesh.triangles.pop_back();
  std::size_t unsure = 0;
  for (int axis = 0; axis < 3; ++axis) unsure += ScanLines(mesh, {4, 4, 4}, axis).unsure_lines();
  EXPECT_GT(unsure, 20U);
}

}  // namespace
}  // namespace knotlight
