#include "pipeline/end_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/shape.h"
#include "pipeline/sample_points.h"

namespace knotlight {
namespace {

constexpr double lambda = 2.0;

// Charges of total strength 1 all over the surface, raised by `height`.
PointSources raised(const Shape& shape, std::size_t count, double height) {
  const SurfaceSamples at =
      columns(stratified_surface_points(shape, count, true, 1, Stream::tests));
  const Eigen::Index n = at.positions.cols();
  return {at.positions + height * at.normals,
          Eigen::VectorXd::Constant(n, std::exp(lambda * height) / static_cast<double>(n)),
          at.positions, at.normals, Eigen::VectorXd::Constant(n, 1.0)};
}

// An even layer of total charge 1 on a sphere. Each place sees some 50 of the stratified charges:
// within 30 %, and with 4000 places the mean within 0.5 %.
TEST(EndLayer, IsEvenOnASphereAndLosesNothing) {
  const Sphere sphere{Vec3(1, 2, 3), 0.5};
  constexpr std::size_t count = 20'000;
  const double area = surface_area(sphere);
  const EndLayer layer(raised(sphere, count, 2.0 * std::sqrt(area / count)), lambda);
  const SurfaceSamples at =
      columns(stratified_surface_points(sphere, 4000, true, 2, Stream::tests));
  const Eigen::VectorXd density = layer.density(at.positions, at.normals, Workers(2));
  EXPECT_NEAR(density.mean() * area, 1.0, 0.005);
  EXPECT_GT(density.minCoeff() * area, 0.7);
  EXPECT_LT(density.maxCoeff() * area, 1.3);
  EXPECT_EQ(density, layer.density(at.positions, at.normals, Workers(1)));
}

// One end: a parabola of radius twice its height, nothing beyond, nothing on the far side of a
// plate thinner than that, nothing of charges that are not raised or have no image.
TEST(EndLayer, SingleEnds) {
  constexpr double height = 0.1, radius = 0.2;
  PointSources sources{Points::Zero(3, 3), Eigen::VectorXd::Ones(3), Points::Zero(3, 3),
                       Vec3::UnitZ().replicate(1, 3), Eigen::VectorXd::Ones(3)};
  sources.positions.row(2) << height, -height, height;
  sources.clear_heights[2] = -1.0;
  const EndLayer layer(sources, lambda);
  Points x(3, 4), n = Vec3::UnitZ().replicate(1, 4);
  x << 0.0, 0.5 * radius, 1.001 * radius, 0.0,  //
      0.0, 0.0, 0.0, 0.0,                       //
      0.0, 0.0, 0.0, -0.25 * radius;
  n.col(3) *= -1.0;
  const Eigen::VectorXd density = layer.density(x, n, Workers(1));
  const double peak = std::exp(-lambda * height) * 2.0 / (std::numbers::pi * radius * radius);
  EXPECT_NEAR(density[0], peak, 1e-12 * peak);
  EXPECT_NEAR(density[1], 0.75 * peak, 1e-12 * peak);
  EXPECT_EQ(density[2], 0.0);
  EXPECT_EQ(density[3], 0.0);
}

TEST(EndLayer, OfNothingIsNothing) {
  const EndLayer layer(PointSources{Points(3, 0), {}, Points(3, 0), Points(3, 0), {}}, lambda);
  const Points x = Points::Zero(3, 2), n = Vec3::UnitZ().replicate(1, 2);
  EXPECT_EQ(layer.density(x, n, Workers(1)), Eigen::VectorXd::Zero(2));
}

}  // namespace
}  // namespace knotlight
