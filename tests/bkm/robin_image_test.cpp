#include "bkm/robin_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

constexpr double k = 0.7;
const Vec3 normal = Vec3(1.0, -2.0, 2.0) / 3.0;
const Vec3 plane(0.3, 0.2, -0.1);

// The plane point at distance `along` from the foot of the charge, and the charge `depth` below it.
Vec3 on_plane(double along) {
  return plane + along * Frame(normal).t;
}
Vec3 below(double depth) {
  return plane - depth * normal;
}

// The stated 1.1e-3: the Robin value that is left on the plane is k times the error of the line's
// derivative plus that of its value; the value is measured on its own against the integral.
constexpr double line_error = 1.1e-3;

// (2/k) int exp(-s/k) G ds by the midpoint rule in ln s, whose error falls faster than any power of
// the step: 1e-10 here.
double line_field(double along, double depth, double lambda) {
  constexpr double step = 0.02;
  double sum = 0.0;
  for (double u = -20.0; u < 4.5; u += step) {
    const double s = k * std::exp(u);
    const double r = std::hypot(along, depth + s);
    sum += step * s * std::exp(-s / k - lambda * r) / r;
  }
  return 2.0 / k * sum / (4.0 * std::numbers::pi);
}

TEST(RobinImage, LineIsRightToTheStatedErrorEverywhereOnThePlane) {
  double worst = 0.0;
  for (const double lambda : {0.0, 0.5 / k, 1.2 / k})
    for (const double depth : {0.0, 0.01, 0.05, 0.1499, 0.1501, 0.3, 0.5, 0.7999, 0.8001, 1.5, 4.0})
      for (double along = 0.003; along < 40.0; along *= 1.3) {
        const Vec3 x = on_plane(along * k);
        const Vec3 y = below(depth * k);
        const double own = point_charge_field(x - y, lambda).value;
        const double line =
            2.0 * own - (own + robin_image_field(x, y, plane, normal, lambda, k).value);
        worst = std::max(worst, std::abs(line - line_field(along * k, depth * k, lambda)) / own);
      }
  EXPECT_LT(worst, line_error);
  EXPECT_GT(worst, 0.5 * line_error);  // or the statement is out of date
}

// u + k du/dn relative to what the charge alone leaves, far from its foot and near.
TEST(RobinImage, MeetsTheRobinCondition) {
  for (const double lambda : {0.0, 1.0})
    for (const double depth : {0.02, 0.3, 1.0})
      for (const double along : {0.0, 0.2, 1.0, 3.0}) {
        const Vec3 x = on_plane(along);
        const Vec3 y = below(depth);
        const FieldSample own = point_charge_field(x - y, lambda);
        const FieldSample image = robin_image_field(x, y, plane, normal, lambda, k);
        const double alone = own.value + k * std::abs(own.gradient.dot(normal));
        const double left = own.value + image.value + k * normal.dot(own.gradient + image.gradient);
        // Fitted for values; their derivatives are ten times less accurate.
        EXPECT_LT(std::abs(left) / alone, 10.0 * line_error) << depth << ' ' << along;
      }
}

// All in all no charge is left, so that the field falls off as a dipole's.
TEST(RobinImage, ChargesAddUpToZero) {
  for (const double depth : {0.0, 0.2, 2.0}) {
    double sum = 3.0;
    for (const PointCharge& charge : robin_image(below(depth), 3.0, plane, normal, k, 0.0)) {
      sum += charge.strength;
      EXPECT_GE(normal.dot(charge.position - plane), depth - 1e-12);
    }
    EXPECT_NEAR(sum, 0.0, 2.0 * 3.0 * line_error);
  }
}

// With little room the condition still holds at the foot, and roughly around it: much better than
// with what fits of the line alone.
TEST(RobinImage, GathersWhatThereIsNoRoomFor) {
  constexpr double lambda = 0.8;
  constexpr double depth = 0.1;
  const Vec3 y = below(depth);
  const Vec3 foot = on_plane(0.0);
  for (const double clear : {0.12, 0.3, 0.8}) {
    const RobinImage image = robin_image(y, 1.0, plane, normal, k, lambda, clear);
    const auto robin = [&](const Vec3& x, int used) {
      const FieldSample own = point_charge_field(x - y, lambda);
      double sum = own.value + k * own.gradient.dot(normal);
      for (int i = 0; i < used; ++i) {
        const PointCharge& charge = image.charges[static_cast<std::size_t>(i)];
        EXPECT_LE(normal.dot(charge.position - plane), clear + 1e-12);
        const FieldSample field = point_charge_field(x - charge.position, lambda);
        sum += charge.strength * (field.value + k * field.gradient.dot(normal));
      }
      return sum;
    };
    const double own = point_charge_field(foot - y, lambda).value;
    // The line's charges are fitted for values, not for what this takes.
    EXPECT_LT(std::abs(robin(foot, image.count)), 0.15 * own) << clear;
    EXPECT_LT(std::abs(robin(foot, image.count)), 0.5 * std::abs(robin(foot, image.count - 1)))
        << clear;
    EXPECT_LT(std::abs(robin(on_plane(0.5 * clear), image.count)), 0.5 * own) << clear;
  }
  EXPECT_EQ(robin_image(y, 1.0, plane, normal, k, lambda, 0.05).count, 0);
  EXPECT_EQ(robin_image(on_plane(0.0), 1.0, plane, normal, k, lambda, 0.0).count, 1);
}

// An even layer of charge 1 per area at a depth a below the plane: at z > a, C exp(-lambda z) with
// C = k (cosh(lambda a) + sinh(lambda a)/(lambda k)) / (1 + lambda k), by u - k du/dz = 0 at z = 0
// and the jump -1 of du/dz. A charge above the plane stands for a layer on it (a = 0).
TEST(RobinImage, EvenLayersHaveTheirClosedForm) {
  constexpr double lambda = 0.8;
  const auto layer = [&](double depth, double strength, double z) {
    const Vec3 y = below(depth);
    double sum = 0.0;
    constexpr double step = 0.01;  // of ln rho, midpoint rule
    for (double u = -8.0; u < 4.0; u += step) {
      const double rho = std::exp(u);
      const Vec3 x = below(z) + rho * Frame(normal).b;
      double field = strength * point_charge_field(x - y, lambda).value;
      for (const PointCharge& charge : robin_image(y, strength, plane, normal, k, lambda))
        field += charge.strength * point_charge_field(x - charge.position, lambda).value;
      sum += 2.0 * std::numbers::pi * rho * rho * step * field;
    }
    return sum;
  };
  const auto closed_form = [&](double a, double z) {
    return k * (std::cosh(lambda * a) + std::sinh(lambda * a) / (lambda * k)) / (1.0 + lambda * k) *
           std::exp(-lambda * z);
  };
  for (const double z : {0.2, 0.5, 1.5}) {
    EXPECT_NEAR(layer(0.0, 1.0, z) / closed_form(0.0, z), 1.0, 5.0 * line_error);
    EXPECT_NEAR(layer(0.1, 1.0, z) / closed_form(0.1, z), 1.0, 5.0 * line_error);
    for (const double height : {0.02, 0.2})
      EXPECT_NEAR(layer(-height, std::exp(lambda * height), z) / closed_form(0.0, z), 1.0,
                  5.0 * line_error);
  }
  // On the plane, right below a charge of a layer: finite, unlike on a charge of the plane.
  EXPECT_TRUE(std::isfinite(robin_image_field(plane, below(-0.1), plane, normal, lambda, k).value));
}

TEST(RobinImage, GradientIsThatOfTheValue) {
  const Vec3 d(0.3, -0.4, 1.1);
  const double h = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = h * Vec3::Unit(axis);
    const double slope =
        (point_charge_field(d + step, 2.0).value - point_charge_field(d - step, 2.0).value) /
        (2.0 * h);
    EXPECT_NEAR(point_charge_field(d, 2.0).gradient[axis], slope, 1e-9);
  }
}

}  // namespace
}  // namespace knotlight
