#include "rivals/irradiance_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "core/sampling.h"
#include "rivals/dipole.h"

namespace knotlight {
namespace {

using std::numbers::pi;

DipoleKernel kernel_of(double sigma_t, double albedo) {
  return dipole_kernel({(1.0 - albedo) * sigma_t, albedo * sigma_t, 0.0, 1.0, 0.0},
                       DipoleForm::classic);
}

// Points of a unit sphere under a beam along -x, so that half of them are dark.
std::vector<EnteringLight> lit_sphere(int count) {
  Rng rng(3, Stream::tests, 0);
  std::vector<EnteringLight> points;
  for (int i = 0; i < count; ++i) {
    const double u = rng.uniform();
    const Vec3 x = sample_sphere(u, rng.uniform());
    const double area = 4.0 * pi / count;
    points.push_back({x, area, area * std::max(0.0, x.x())});
  }
  return points;
}

double brute_force(const std::vector<EnteringLight>& points, const Vec3& x,
                   const DipoleKernel& kernel) {
  double sum = 0.0;
  for (const EnteringLight& point : points)
    sum += point.power * kernel((x - point.position).squaredNorm());
  return sum;
}

// Largest error of the tree in parts of the sum, or, where that is less than 1 % of the brightest,
// of this. On the lit and the dark side.
double worst_error(const IrradianceTree& tree, const std::vector<EnteringLight>& points,
                   const DipoleKernel& kernel, double solid_angle) {
  Rng rng(4, Stream::tests, 0);
  constexpr int places = 40;
  Eigen::ArrayXd exact(places), error(places);
  for (int i = 0; i < places; ++i) {
    const double u = rng.uniform();
    const Vec3 x = sample_sphere(u, rng.uniform());
    exact[i] = brute_force(points, x, kernel);
    error[i] = std::abs(tree.exitance(x, kernel, solid_angle) - exact[i]);
  }
  return (error / exact.max(0.01 * exact.maxCoeff())).maxCoeff();
}

TEST(IrradianceTree, EqualsBruteForceWithoutASolidAngle) {
  const auto points = lit_sphere(3'000);
  const IrradianceTree tree(points);
  EXPECT_LT(tree.size(), 1'700U);  // the dark half is left out
  double power = 0.0;
  for (const EnteringLight& point : points) power += point.power;
  EXPECT_NEAR(tree.power(), power, 1e-12);
  for (const double sigma_t : {1.0, 10.0, 100.0})
    EXPECT_LT(worst_error(tree, points, kernel_of(sigma_t, 0.99), 0.0), 1e-11) << sigma_t;
}

// From bodies as thin as their mean free path to dense ones, from strong absorption to none: the
// solid angle that dipoles take by default keeps the sum within 1 %, and smaller ones are better.
TEST(IrradianceTree, IsWithinOnePercentByDefault) {
  const auto points = lit_sphere(8'000);
  const IrradianceTree tree(points);
  const double solid_angle = DipoleSettings().solid_angle;
  for (const double sigma_t : {1.0, 5.0, 40.0})
    for (const double albedo : {0.9, 0.99, 1.0}) {
      const DipoleKernel kernel = kernel_of(sigma_t, albedo);
      const double error = worst_error(tree, points, kernel, solid_angle);
      EXPECT_LT(error, 0.01) << sigma_t << " " << albedo;
      EXPECT_LT(worst_error(tree, points, kernel, solid_angle / 16.0), 0.25 * error)
          << sigma_t << " " << albedo;
    }
}

// Two clusters on a line. A place in the tree's box, but far from both, sees two points at their
// centres of power.
TEST(IrradianceTree, FarCellIsItsCentreOfPower) {
  std::vector<EnteringLight> points;
  double power = 0.0, moment = 0.0;
  for (int i = 0; i < 20; ++i) {
    points.push_back({Vec3(0.001 * i, 0, 0), 1e-6, 1.0 + i});
    points.push_back({Vec3(5.0 - 0.001 * i, 0, 0), 1e-6, 2.0});
    power += 1.0 + i;
    moment += (1.0 + i) * 0.001 * i;
  }
  const DipoleKernel kernel = kernel_of(1.0, 0.9);
  const Vec3 x(0.5, -2.4, 0);
  const double expected = power * kernel((x - Vec3(moment / power, 0, 0)).squaredNorm()) +
                          40.0 * kernel((x - Vec3(5.0 - 0.0095, 0, 0)).squaredNorm());
  EXPECT_NEAR(IrradianceTree(points).exitance(x, kernel, 1e-3), expected, 1e-12 * expected);
}

TEST(IrradianceTree, PointsInOnePlaceAndNone) {
  const std::vector<EnteringLight> points(100, {Vec3(1, 2, 3), 0.1, 0.5});
  const DipoleKernel kernel = kernel_of(2.0, 0.9);
  EXPECT_NEAR(IrradianceTree(points).exitance(Vec3(1, 2, 3), kernel, 0.1), 50.0 * kernel(0.0),
              1e-12 * 50.0 * kernel(0.0));
  EXPECT_EQ(IrradianceTree({}).exitance(Vec3::Zero(), kernel, 0.1), 0.0);
  EXPECT_EQ(IrradianceTree({{Vec3::Zero(), 1.0, 0.0}}).size(), 0U);
}

}  // namespace
}  // namespace knotlight
