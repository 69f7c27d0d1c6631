#include "stability/body.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

// Errors of means over n points of the sequence fall as log(n)/n.
constexpr std::size_t many = 20'000;
constexpr double mean_tolerance = 2e-3;
constexpr double rounding = 1e-12;
constexpr double step = 1e-6;              // of central differences
constexpr double difference_error = 1e-8;  // rounding over the step; their own error is less
constexpr double marching = 2e-3;          // a step beyond the surface

class EveryBody : public testing::TestWithParam<Body (*)()> {
 protected:
  Body body = GetParam()();
};

TEST_P(EveryBody, PointsLieOnTheSurfaceWithItsNormal) {
  const SpreadKnots knots = spread_over(body, 200);
  for (Eigen::Index i = 0; i < knots.positions.cols(); ++i) {
    const Vec3 x = knots.positions.col(i), n = knots.normals.col(i);
    EXPECT_NEAR(body.depth(x), 0.0, rounding);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 h = step * Vec3::Unit(axis);
      EXPECT_NEAR((body.depth(x - h) - body.depth(x + h)) / (2.0 * step), n[axis],
                  difference_error);
    }
  }
}

// Points of equal areas: the divergence theorem, int x.n dA = 3 V, V of the mesh.
TEST_P(EveryBody, PointsAreSpreadByArea) {
  const SpreadKnots knots = spread_over(body, many);
  const double mean = knots.positions.cwiseProduct(knots.normals).colwise().sum().mean();
  EXPECT_NEAR(mean * body.area / (3.0 * volume(body.shape)), 1.0, mean_tolerance);
  EXPECT_NEAR(surface_area(body.shape) / body.area, 1.0, mean_tolerance);
  EXPECT_NEAR(0.5 * bounds(body.shape).largest_extent() / body.half_extent, 1.0, mean_tolerance);
}

TEST_P(EveryBody, FootIsOnTheSurface) {
  EXPECT_NEAR(body.depth(body.foot.position), 0.0, rounding);
}

INSTANTIATE_TEST_SUITE_P(Body, EveryBody, testing::Values(&unit_ball, &thin_torus));

TEST(Torus, PrefixesAreSpreadToo) {
  const Body body = thin_torus();
  // The mean of the distance from the axis over the surface is 1 + 0.35^2 / 2: the outer side has
  // more area.
  for (const std::size_t count : {1000UL, many}) {
    const SpreadKnots knots = spread_over(body, count);
    EXPECT_NEAR(knots.positions.topRows(2).colwise().norm().mean(), 1.0 + 0.5 * 0.35 * 0.35,
                count == many ? mean_tolerance : 0.01);
  }
}

TEST(Queries, SeeTheHoleOfTheTorus) {
  const BodyQueries q = queries(thin_torus());
  EXPECT_TRUE(q.inside({1.0, 0.0, 0.3}));
  EXPECT_FALSE(q.inside(Vec3::Zero()));
  EXPECT_FALSE(q.connected({1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}));
  EXPECT_TRUE(q.connected({1.0, 0.0, 0.0}, {1.0, 0.0, 0.34}));
  // Along the inner side from one point of the surface to another.
  EXPECT_FALSE(q.connected({0.65, 0.0, 0.0}, {0.0, 0.65, 0.0}));
  EXPECT_NEAR(q.thickness({1.35, 0.0, 0.0}, -Vec3::UnitX()), 0.7, marching);
  EXPECT_NEAR(queries(unit_ball()).thickness(Vec3::UnitZ(), -Vec3::UnitZ()), 2.0, marching);
}

}  // namespace
}  // namespace knotlight
