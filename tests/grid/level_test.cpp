#include "grid/level.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid/grid_cases.h"

namespace knotlight {
namespace {

using namespace grid_cases;

// A box on the grid has one unknown per node.
TEST(Level, UnknownsOfABox) {
  const auto g = geometry(box_mesh(Vec3(0, 0, 0), Vec3(1, 0.5, 0.25)), 1.0 / 16.0);
  EXPECT_EQ(g->finest().dofs, 17 * 9 * 5);
  EXPECT_EQ(g->finest().pieces.size(), 16U * 8U * 4U);
}

// Smooth shapes are in one piece per cell and have hardly a node to spare.
TEST(Level, ASphereIsNotTorn) {
  const auto g = geometry(Sphere{}, 0.05);
  const Level& level = g->finest();
  for (std::size_t p = 1; p < level.pieces.size(); ++p)
    ASSERT_NE(level.pieces[p].cell, level.pieces[p - 1].cell);
  std::vector<bool> node(static_cast<std::size_t>(level.grid.n[0] + 1) *
                         static_cast<std::size_t>(level.grid.n[1] + 1) *
                         static_cast<std::size_t>(level.grid.n[2] + 1));
  for (const Piece& piece : level.pieces)
    for (int c = 0; c < 8; ++c) {
      const auto p = level.grid.position(piece.cell);
      const auto o = corner_offset(c);
      node[static_cast<std::size_t>(((p[2] + o[2]) * (level.grid.n[1] + 1) + p[1] + o[1]) *
                                        (level.grid.n[0] + 1) +
                                    p[0] + o[0])] = true;
    }
  const auto nodes = std::count(node.begin(), node.end(), true);
  EXPECT_LE(level.dofs, nodes + nodes / 1000);
}

// No unknown is shared across a gap, whether it runs along a grid plane, inside cells or slanted.
TEST(Level, GapsDivide) {
  for (const double gap : {0.001, 0.02, 0.07, 0.15})
    for (const double shift : {0.0, 0.013, 0.031, 0.05})
      for (const bool slanted : {false, true}) {
        TriangleMesh mesh = box_mesh(Vec3(-0.5, -0.5, shift + gap / 2), Vec3(0.5, 0.5, 0.6));
        append(mesh, box_mesh(Vec3(-0.5, -0.5, -0.6), Vec3(0.5, 0.5, shift - gap / 2)));
        if (slanted)
          for (Vec3& v : mesh.vertices) v = tilt() * v;
        const auto g = geometry(mesh, 0.1);
        ASSERT_TRUE(g->ok());
        const Level& level = g->finest();
        // Spread a colour from a piece in the upper box over shared unknowns.
        std::vector<bool> reached(static_cast<std::size_t>(level.dofs));
        const Vec3 up = slanted ? Vec3(tilt() * Vec3(0, 0, 0.4)) : Vec3(0, 0, 0.4);
        for (const std::int32_t dof :
             level.pieces[static_cast<std::size_t>(g->locate(up).piece)].dof)
          reached[static_cast<std::size_t>(dof)] = true;
        for (bool changed = true; changed;) {
          changed = false;
          for (const Piece& piece : level.pieces) {
            bool any = false, all = true;
            for (const std::int32_t dof : piece.dof) {
              any = any || reached[static_cast<std::size_t>(dof)];
              all = all && reached[static_cast<std::size_t>(dof)];
            }
            if (!any || all) continue;
            changed = true;
            for (const std::int32_t dof : piece.dof) reached[static_cast<std::size_t>(dof)] = true;
          }
        }
        const auto below = g->locate(-up);
        EXPECT_FALSE(reached[static_cast<std::size_t>(
            level.pieces[static_cast<std::size_t>(below.piece)].dof[0])])
            << "gap " << gap << " shift " << shift << " slanted " << slanted;
      }
}

}  // namespace
}  // namespace knotlight
