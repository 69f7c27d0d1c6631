#include "grid/geometry.h"

#include <gtest/gtest.h>

#include "grid/grid_cases.h"

namespace knotlight {
namespace {

using namespace grid_cases;

// Volume by 4 x 4 lines per cell; area exactly.
TEST(GridGeometry, VolumeAndArea) {
  const std::vector<Shape> shapes{Sphere{Vec3(0.3, 0.1, 0.0), 1.0}, tilted_box(Vec3(1, 0.7, 0.5)),
                                  torus(1.0, 0.4, 60, 30), box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1))};
  for (const Shape& shape : shapes) {
    const auto g = geometry(shape, 1.0 / 16.0);
    ASSERT_TRUE(g->resolved()) << g->unresolved();
    EXPECT_LT(g->quality().volume_error, 1e-4);
    EXPECT_LT(g->quality().area_error, 1e-3);  // of the sphere's polyhedron
    const NodeWeights w = node_weights(g->finest());
    EXPECT_NEAR(w.volume.sum() / volume(shape), 1.0, 1e-4);
    EXPECT_NEAR(w.surface.sum() / surface_area(shape), 1.0, 1e-3);
  }
}

// Coarser grids hold the same integrals.
TEST(GridGeometry, CoarserLevelsKeepTotals) {
  const auto g = geometry(Sphere{}, 0.1);
  for (const Level& level : g->levels()) {
    const NodeWeights w = node_weights(level);
    EXPECT_NEAR(w.volume.sum() / node_weights(g->finest()).volume.sum(), 1.0, 1e-12);
    EXPECT_NEAR(w.surface.sum() / node_weights(g->finest()).surface.sum(), 1.0, 1e-12);
  }
}

// The second level is no grid of its own where it joins what a gap divides.
TEST(GridGeometry, NestedCoarseGrid) {
  EXPECT_TRUE(geometry(Sphere{}, 0.1)->has_nested_coarse());
  EXPECT_FALSE(geometry(Sphere{}, 0.5)->has_nested_coarse());  // there is none
  TriangleMesh apart = box_mesh(Vec3(-0.5, -0.5, 0.01), Vec3(0.5, 0.5, 0.6));
  append(apart, box_mesh(Vec3(-0.5, -0.5, -0.6), Vec3(0.5, 0.5, -0.01)));
  const auto g = geometry(apart, 0.05);
  ASSERT_GT(g->levels().size(), 1U);
  EXPECT_FALSE(g->has_nested_coarse());
}

TEST(GridGeometry, SameBitsForAnyThreadCount) {
  const Shape shape = torus(1.0, 0.4, 40, 20);
  const GridGeometry one(shape, 0.05, Workers(1)), three(shape, 0.05, Workers(3));
  ASSERT_EQ(one.finest().dofs, three.finest().dofs);
  for (std::size_t c = 0; c < one.finest().cuts.size(); ++c) {
    ASSERT_EQ(one.finest().cuts[c].volume, three.finest().cuts[c].volume);
    ASSERT_EQ(one.finest().cuts[c].surface, three.finest().cuts[c].surface);
  }
}

// Every point inside and on the surface has a cell; far points have none.
TEST(GridGeometry, Locate) {
  const auto g = geometry(Sphere{}, 0.1);
  const Samples s = samples(Sphere{}, 5000);
  for (Eigen::Index i = 0; i < s.positions.cols(); ++i) {
    const Place on = g->locate(s.positions.col(i), s.normals.col(i));
    ASSERT_GE(on.piece, 0);
    EXPECT_GE(on.local.minCoeff(), -0.25);
    EXPECT_LE(on.local.maxCoeff(), 1.25);
    EXPECT_GE(g->locate(0.7 * s.positions.col(i)).piece, 0);
  }
  EXPECT_LT(g->locate(Vec3(1.5, 0, 0)).piece, 0);
  EXPECT_LT(g->locate(Vec3::Constant(std::nan(""))).piece, 0);
}

// What cells cannot resolve: said so, no crash.
TEST(GridGeometry, SliversAreNotResolved) {
  const std::vector<Shape> shapes{
      tilted_box(Vec3(1.0, 0.005, 0.005)),               // needle of a tenth of a cell
      tilted_box(Vec3(1.0, 1.0, 0.005)),                 // plate of a tenth of a cell
      box_mesh(Vec3(-1, -1, 0.001), Vec3(1, 1, 0.003)),  // between all places
      tilted_box(Vec3::Constant(1e-3)), Sphere{Vec3::Zero(), 0.04}};
  for (const Shape& shape : shapes) {
    const auto g = geometry(shape, 0.1);
    EXPECT_FALSE(g->resolved());
    EXPECT_FALSE(g->unresolved().empty());
  }
  EXPECT_FALSE(geometry(Sphere{}, 1e-4)->ok());
  EXPECT_FALSE(geometry(Sphere{}, 0.0)->ok());
  TriangleMesh inside_out = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_FALSE(geometry(inside_out, 0.1)->ok());
}

}  // namespace
}  // namespace knotlight
