#include "grid/surface_pieces.h"

#include <gtest/gtest.h>

#include "grid/grid_cases.h"
#include "grid/shape_mesh.h"

namespace knotlight {
namespace {

using namespace grid_cases;

constexpr double rounding = 1e-12;

// Pieces cover the surface once, lie in their cells, and their quadrature is exact for degree 4.
TEST(SurfacePieces, PartitionTheSurface) {
  for (const TriangleMesh& shape : {tilted_box(Vec3(1.0, 0.7, 0.4)), torus(1.0, 0.4, 24, 12)}) {
    const CellGrid grid = grid_around(Shape(shape), 0.13);
    const TriangleMesh mesh = mesh_in_cells(Shape(shape), grid);
    double area = 0.0, fourth = 0.0, volume = 0.0;
    for_each_surface_piece(mesh, [&](const SurfacePiece& piece) {
      area += piece.area;
      for (const SurfaceNode& node : quadrature(piece)) {
        fourth += node.weight * std::pow(node.position.x(), 4);
        volume += node.weight * piece.normal.dot(node.position) / 3.0;
        for (int a = 0; a < 3; ++a) {
          EXPECT_GE(node.position[a], piece.cell[static_cast<std::size_t>(a)] - rounding);
          EXPECT_LE(node.position[a], piece.cell[static_cast<std::size_t>(a)] + 1 + rounding);
        }
      }
    });
    EXPECT_NEAR(area / surface_area(mesh), 1.0, rounding);
    EXPECT_NEAR(volume / signed_volume(mesh), 1.0, rounding);
    // int x^4 over a triangle of area S = (S/15) sum over monomials of degree 4 in its corners' x.
    double exact = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double a = mesh.corner(t, 0).x(), b = mesh.corner(t, 1).x(), c = mesh.corner(t, 2).x();
      double sum = 0.0;
      for (int i = 0; i <= 4; ++i)
        for (int j = 0; i + j <= 4; ++j)
          sum += std::pow(a, i) * std::pow(b, j) * std::pow(c, 4 - i - j);
      exact += mesh.area(t) / 15.0 * sum;
    }
    EXPECT_NEAR(fourth / exact, 1.0, rounding);
  }
}

// Surface in a grid plane belongs to the cells on its inner side.
TEST(SurfacePieces, InAGridPlane) {
  int pieces = 0;
  for_each_surface_piece(box_mesh(Vec3(1, 1, 1), Vec3(3, 3, 3)), [&](const SurfacePiece& piece) {
    ++pieces;
    for (const int c : piece.cell) EXPECT_TRUE(c == 1 || c == 2);
  });
  EXPECT_GE(pieces, 24);
}

}  // namespace
}  // namespace knotlight
