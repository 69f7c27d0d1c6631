#include "bkm/knots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

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

double smallest_distance(const Points& p) {
  double least = 1e300;
  for (Eigen::Index i = 1; i < p.cols(); ++i)
    least = std::min(least, (p.leftCols(i).colwise() - p.col(i)).colwise().norm().minCoeff());
  return least;
}

// Half the best that so many points could have is a theorem [G85], two thirds of it what the
// layout reaches; hexagons are the best in the plane: distance^2 = 2 area / (sqrt(3) count).
TEST(Knots, BlueNoiseKeepsItsDistance) {
  const Shape shapes[] = {Sphere{Vec3(1.0, 2.0, 3.0), 2.0},
                          box_mesh(Vec3(0.0, 0.0, 0.0), Vec3(2.0, 1.0, 0.5))};
  for (const Shape& shape : shapes) {
    constexpr std::size_t count = 300;
    const SurfaceSamples knots = surface_knots(shape, KnotLayout::blue_noise, count, 4);
    ASSERT_EQ(knots.positions.cols(), 300);
    const double best = std::sqrt(2.0 * surface_area(shape) / (std::sqrt(3.0) * count));
    EXPECT_GT(smallest_distance(knots.positions), 0.66 * best);
    EXPECT_LT(smallest_distance(surface_knots(shape, KnotLayout::jittered, count, 4).positions),
              0.4 * best);
    // The same for the same seed, another for another.
    EXPECT_EQ(knots.positions, surface_knots(shape, KnotLayout::blue_noise, count, 4).positions);
    EXPECT_NE(knots.positions, surface_knots(shape, KnotLayout::blue_noise, count, 5).positions);
    for (Eigen::Index i = 0; i < 300; ++i) EXPECT_NEAR(knots.normals.col(i).norm(), 1.0, 1e-14);
  }
}

TEST(Knots, FarthestPointsAgreeWithBruteForce) {
  const Points p = bkm_cases::cube_checks(60, 0.0, 1.0);
  const std::vector<Eigen::Index> chosen = farthest_points(p, 10);
  ASSERT_EQ(chosen.size(), 10u);
  EXPECT_EQ(chosen[0], 0);
  for (std::size_t step = 1; step < 10; ++step) {
    const auto distance = [&](Eigen::Index i) {
      double d = 1e300;
      for (std::size_t j = 0; j < step; ++j) d = std::min(d, (p.col(i) - p.col(chosen[j])).norm());
      return d;
    };
    for (Eigen::Index i = 0; i < 60; ++i) EXPECT_LE(distance(i), distance(chosen[step]) + 1e-14);
  }
}

TEST(Knots, VerticesOfAMesh) {
  const TriangleMesh box = box_mesh(Vec3::Constant(-1.0), Vec3::Constant(1.0));
  const SurfaceSamples all = surface_knots(box, KnotLayout::vertices, 100, 1);
  ASSERT_EQ(all.positions.cols(), 8);
  // Three facets of equal angle sums meet at every corner.
  for (Eigen::Index i = 0; i < 8; ++i)
    EXPECT_LT((all.normals.col(i) - all.positions.col(i).normalized()).norm(), 1e-12);
  const SurfaceSamples some = surface_knots(refine(box, 0.3), KnotLayout::vertices, 50, 1);
  EXPECT_EQ(some.positions.cols(), 50);
  EXPECT_GT(smallest_distance(some.positions), 0.3);
}

// 10 n^2 + 2, nearest to what was asked for; none twice.
TEST(Knots, VerticesOfASphere) {
  for (const auto& [asked, expected] : {std::pair{4, 12}, {12, 12}, {484, 492}, {1000, 1002}}) {
    const SurfaceSamples knots = surface_knots(
        Sphere{Vec3(0.0, 1.0, 0.0), 3.0}, KnotLayout::vertices, static_cast<std::size_t>(asked), 1);
    ASSERT_EQ(knots.positions.cols(), expected);
    EXPECT_GT(smallest_distance(knots.positions), 1.6 * 3.0 / std::sqrt(expected));
    for (Eigen::Index i = 0; i < expected; ++i)
      EXPECT_LT((knots.positions.col(i) - Vec3(0.0, 1.0, 0.0) - 3.0 * knots.normals.col(i)).norm(),
                1e-14);
  }
}

TEST(Knots, StrataAreThoseOfTheShape) {
  const Shape ball = Sphere{};
  const SurfaceSamples centres = surface_knots(ball, KnotLayout::stratified, 50, 1);
  EXPECT_EQ(centres.positions, surface_knots(ball, KnotLayout::stratified, 50, 2).positions);
  const auto expected = stratified_surface_points(ball, 50, true, 7, Stream::boundary_knots);
  const SurfaceSamples jittered = surface_knots(ball, KnotLayout::jittered, 50, 7);
  for (Eigen::Index i = 0; i < 50; ++i)
    EXPECT_EQ(Vec3(jittered.positions.col(i)), expected[static_cast<std::size_t>(i)].position);
}

TEST(Knots, LatticeInABall) {
  const Points surface = bkm_cases::sphere(400).points;
  const double volume = 4.0 / 3.0 * std::numbers::pi;
  const InteriorKnots knots =
      grid_knots(surface, volume, 800, [](const Vec3& x) { return x.norm() < 1.0; });
  // If all within half a spacing of the surface were missing, 0.76 of them would stay.
  EXPECT_GT(static_cast<double>(knots.points.cols()), 0.76 * 800);
  EXPECT_LT(static_cast<double>(knots.points.cols()), 800);
  const double h = std::cbrt(volume / 800);
  EXPECT_NEAR(smallest_distance(knots.points), h, 1e-12);
  EXPECT_LT(knots.points.colwise().norm().maxCoeff(), 1.0);
  for (Eigen::Index i = 0; i < knots.points.cols(); ++i)
    EXPECT_GE((surface.colwise() - knots.points.col(i)).colwise().norm().minCoeff(), 0.5 * h);
}

TEST(Knots, LayersOfTheLayouts) {
  EXPECT_TRUE(layer_depths(InteriorLayout::none).empty());
  EXPECT_EQ(layer_depths(InteriorLayout::one_layer), std::vector<double>{1.5});
  EXPECT_EQ(layer_depths(InteriorLayout::near_layers), (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(layer_depths(InteriorLayout::two_layers), (std::vector<double>{1.0, 1.5}));
  EXPECT_TRUE(layer_depths(InteriorLayout::grid).empty());
}

}  // namespace
}  // namespace knotlight
