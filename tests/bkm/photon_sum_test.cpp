#include "bkm/photon_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "bkm/charge_lanes.h"
#include "bkm/robin_image.h"
#include "core/rng.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double k = 0.05;
// Room for images.
constexpr double everywhere = std::numeric_limits<double>::infinity();
constexpr double nowhere = -1.0;

Vec3 on_sphere(Rng& rng) {
  const double z = 2.0 * rng.uniform() - 1.0;
  const double phi = 2.0 * pi * rng.uniform();
  const double s = std::sqrt(1.0 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

// Photons in a layer below the unit sphere, dense below its upper pole; mixed: of both signs.
PointSources layer(Eigen::Index count, double clear, bool mixed) {
  Rng rng(3, Stream::tests, 2);
  PointSources s;
  s.positions.resize(3, count);
  s.strengths.resize(count);
  s.plane_points.resize(3, count);
  s.plane_normals.resize(3, count);
  s.clear_heights.setConstant(count, clear);
  for (Eigen::Index i = 0; i < count; ++i) {
    Vec3 n = on_sphere(rng);
    if (i % 2 == 0) n = (n + Vec3(0.0, 0.0, 3.0)).normalized();
    const double depth = -std::log(1.0 - 0.999 * rng.uniform()) / 15.0;
    s.positions.col(i) = (1.0 - depth) * n;
    s.strengths[i] = (0.5 + rng.uniform()) * (mixed && i % 3 == 0 ? -1.0 : 1.0);
    s.plane_points.col(i) = n;
    s.plane_normals.col(i) = n;
  }
  return s;
}

struct Targets {
  Points x, n;
};

// On the surface and inside.
Targets targets(Eigen::Index count) {
  Rng rng(4, Stream::tests, 3);
  Targets t{Points(3, count), Points(3, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    t.n.col(i) = on_sphere(rng);
    t.x.col(i) = (i % 3 == 0 ? std::cbrt(rng.uniform()) : 1.0) * t.n.col(i);
  }
  return t;
}

struct Oracle {
  Eigen::VectorXd value, derivative;
  Eigen::VectorXd magnitude, slope_magnitude;  // what the tolerance is a share of
};

Oracle brute_force(const PointSources& s, double lambda, const Targets& t) {
  std::vector<PointCharge> charges;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    charges.push_back({s.positions.col(i), s.strengths[i]});
    if (s.clear_heights[i] < 0.0) continue;
    for (const PointCharge& charge :
         robin_image(s.positions.col(i), s.strengths[i], s.plane_points.col(i),
                     s.plane_normals.col(i), k, lambda, s.clear_heights[i]))
      charges.push_back(charge);
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(t.x.cols());
  Oracle o{zero, zero, zero, zero};
  for (Eigen::Index i = 0; i < t.x.cols(); ++i)
    for (const PointCharge& charge : charges) {
      const FieldSample field = point_charge_field(t.x.col(i) - charge.position, lambda);
      o.value[i] += charge.strength * field.value;
      o.derivative[i] += charge.strength * field.gradient.dot(t.n.col(i));
      o.magnitude[i] += std::abs(charge.strength) * field.value;
      o.slope_magnitude[i] += std::abs(charge.strength) * (field.value / k + field.gradient.norm());
    }
  return o;
}

struct Case {
  double lambda;
  double tolerance;
  double clear;
  bool mixed;
};

class PhotonSumCases : public testing::TestWithParam<Case> {};

// The oracle: every point within the tolerance, all within the reported bound, and neither bound
// nor estimate absurdly far above the largest true error.
TEST_P(PhotonSumCases, AgreesWithBruteForce) {
  const Case& c = GetParam();
  const Workers workers;
  const PointSources sources = layer(12'000, c.clear, c.mixed);
  const Targets t = targets(500);
  const Oracle exact = brute_force(sources, c.lambda, t);
  PhotonSumOptions options;
  options.tolerance = c.tolerance;
  const PhotonSum sum(sources, c.lambda, k, options, workers);
  const PhotonSumValues got = sum.evaluate(t.x, &t.n, workers);

  const Eigen::ArrayXd error = (got.value - exact.value).array().abs();
  const Eigen::ArrayXd slope_error = (got.normal_derivative - exact.derivative).array().abs();
  // In the dark, relative to what is dark.
  const Eigen::ArrayXd scale = exact.magnitude.array().max(1e-4 * exact.magnitude.mean());
  const Eigen::ArrayXd slope_scale =
      exact.slope_magnitude.array().max(1e-4 * exact.slope_magnitude.mean());
  EXPECT_LT((error / scale).maxCoeff(), c.tolerance);
  EXPECT_LT((slope_error / slope_scale).maxCoeff(), c.tolerance);
  EXPECT_LE(error.maxCoeff(), got.error_estimate);
  EXPECT_LE(slope_error.maxCoeff(), got.derivative_error_estimate);
  EXPECT_LE(got.error_estimate, got.error_bound);
  EXPECT_LE(got.derivative_error_estimate, got.derivative_error_bound);
  // The bound supposes that all charges of all clusters err the same way.
  EXPECT_GT(error.maxCoeff(), 1e-5 * got.error_bound);
  EXPECT_GT(error.maxCoeff(), 1e-3 * got.error_estimate);
  // Work is saved even from so few, far-apart points that share decisions.
  const double pairs = static_cast<double>(sum.charges()) * static_cast<double>(t.x.cols());
  EXPECT_LT(static_cast<double>(got.direct_interactions), 0.9 * pairs);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, PhotonSumCases,
    testing::Values(Case{2.0, 1e-2, everywhere, false}, Case{2.0, 1e-1, everywhere, true},
                    Case{0.0, 3e-2, everywhere, false}, Case{0.0, 3e-2, nowhere, true},
                    Case{25.0, 3e-2, 0.1, true}, Case{2.0, 1e-4, nowhere, false}));

TEST(PhotonSum, ValuesAloneAgreeWithBruteForce) {
  const Workers workers;
  const PointSources sources = layer(5'000, everywhere, false);
  const Targets t = targets(100);
  const Oracle exact = brute_force(sources, 2.0, t);
  const PhotonSumValues got =
      PhotonSum(sources, 2.0, k, {}, workers).evaluate(t.x, nullptr, workers);
  EXPECT_LE((got.value - exact.value).cwiseAbs().maxCoeff(), got.error_bound);
  EXPECT_EQ(got.normal_derivative.size(), 0);
}

// Thousands of kilometres or nanometres, megawatts or picowatts.
TEST(PhotonSum, UnitsDoNotMatter) {
  const Workers workers;
  const PointSources sources = layer(3'000, everywhere, true);
  const Targets t = targets(64);
  const PhotonSumValues plain =
      PhotonSum(sources, 2.0, k, {}, workers).evaluate(t.x, &t.n, workers);
  for (const double length : {1e9, 1e-12}) {
    PointSources scaled = sources;
    scaled.positions *= length;
    scaled.plane_points *= length;
    scaled.strengths *= 1e-20;
    const Points x = length * t.x;
    const PhotonSumValues got =
        PhotonSum(scaled, 2.0 / length, k * length, {}, workers).evaluate(x, &t.n, workers);
    EXPECT_LE((got.value * (length * 1e20) - plain.value).cwiseAbs().maxCoeff(), plain.error_bound);
    EXPECT_LE((got.normal_derivative * (length * length * 1e20) - plain.normal_derivative)
                  .cwiseAbs()
                  .maxCoeff(),
              plain.derivative_error_bound);
  }
}

TEST(PhotonSum, SameBitsForAnyNumberOfThreads) {
  const PointSources sources = layer(20'000, everywhere, true);
  const Targets t = targets(500);
  const Workers one(1);
  const Workers three(3);
  const PhotonSumValues a = PhotonSum(sources, 2.0, k, {}, one).evaluate(t.x, &t.n, one);
  const PhotonSumValues b = PhotonSum(sources, 2.0, k, {}, three).evaluate(t.x, &t.n, three);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.normal_derivative, b.normal_derivative);
  EXPECT_EQ(a.error_bound, b.error_bound);
  EXPECT_EQ(a.direct_interactions, b.direct_interactions);
}

TEST(PhotonSum, NoChargesGiveNoField) {
  const Workers workers(1);
  const Targets t = targets(3);
  const PhotonSum none(layer(0, everywhere, false), 1.0, k, {}, workers);
  EXPECT_EQ(none.charges(), 0U);
  EXPECT_EQ(none.evaluate(t.x, &t.n, workers).value, Eigen::VectorXd::Zero(3));
  PointSources dark = layer(10, everywhere, false);
  dark.strengths.setZero();
  EXPECT_EQ(PhotonSum(dark, 1.0, k, {}, workers).evaluate(t.x, &t.n, workers).value,
            Eigen::VectorXd::Zero(3));
}

// Many charges in one place cannot be told apart by any cell.
TEST(PhotonSum, CoincidentCharges) {
  const Workers workers;
  PointSources sources = layer(2'000, nowhere, false);
  for (Eigen::Index i = 0; i < 1'000; ++i) sources.positions.col(i) = sources.positions.col(0);
  const Targets t = targets(50);
  const Oracle exact = brute_force(sources, 2.0, t);
  const PhotonSumValues got = PhotonSum(sources, 2.0, k, {}, workers).evaluate(t.x, &t.n, workers);
  EXPECT_LE((got.value - exact.value).cwiseAbs().maxCoeff(), got.error_bound);
}

PointSources one_charge() {
  PointSources s = layer(1, nowhere, false);
  s.positions.col(0).setZero();
  s.strengths[0] = 1.0;
  return s;
}

// A ball of uniform charge against its defining properties: outside the field of the point; on the
// border value and slope go over smoothly; inside lap u - lambda^2 u = -(3/4 pi eps^3)/F, F the
// factor by which a ball's field outside exceeds a point's.
TEST(PhotonSum, BallsHaveTheFieldOfABall) {
  const Workers workers(1);
  constexpr double eps = 0.2;
  for (const double lambda : {0.0, 1.0, 5.0}) {
    PhotonSumOptions options;
    options.softening = eps;
    const PhotonSum sum(one_charge(), lambda, k, options, workers);
    const auto at = [&](double r) {
      const Points x = r * Vec3::UnitX();
      const Points n = Vec3::UnitX();
      const PhotonSumValues v = sum.evaluate(x, &n, workers);
      return std::pair{v.value[0], v.normal_derivative[0]};
    };
    const FieldSample outside = point_charge_field(Vec3(0.3, 0.0, 0.0), lambda);
    EXPECT_NEAR(at(0.3).first / outside.value, 1.0, 1e-5);
    EXPECT_NEAR(at(0.3).second / outside.gradient.x(), 1.0, 1e-5);
    EXPECT_NEAR(at(0.99999 * eps).first / at(1.00001 * eps).first, 1.0, 1e-4);
    EXPECT_NEAR(at(0.99999 * eps).second / at(1.00001 * eps).second, 1.0, 2e-4);
    EXPECT_EQ(at(0.0).second, 0.0);
    EXPECT_TRUE(std::isfinite(at(0.0).first));

    const double x = lambda * eps;
    const double F = x == 0.0 ? 1.0 : 3.0 * (x * std::cosh(x) - std::sinh(x)) / (x * x * x);
    const double density = 3.0 / (4.0 * pi * eps * eps * eps) / F;
    for (const double r : {0.05, 0.1, 0.15}) {
      const double h = 0.02;  // r^2 u' differentiated: u' is a function of r alone
      const double laplacian =
          ((r + h) * (r + h) * at(r + h).second - (r - h) * (r - h) * at(r - h).second) /
          (2.0 * h * r * r);
      // The difference formula: h^2 (r^2 u')'''/(6 r^2), below 3 %.
      EXPECT_NEAR((laplacian - lambda * lambda * at(r).first) / -density, 1.0, 0.06) << r;
      const double slope = (at(r + h).first - at(r - h).first) / (2.0 * h);
      EXPECT_NEAR(slope / at(r).second, 1.0, 1e-2);
    }
  }
}

// Softened charges under a plane with softened images still meet the Robin condition on it.
TEST(PhotonSum, SoftImagesMeetTheRobinCondition) {
  const Workers workers(1);
  PointSources s = one_charge();
  s.clear_heights[0] = everywhere;
  s.positions.col(0) = Vec3(0.0, 0.0, -0.05);
  s.plane_points.col(0).setZero();
  s.plane_normals.col(0) = Vec3::UnitZ();
  PhotonSumOptions options;
  options.softening = 0.03;
  const Points x = Vec3(0.01, 0.0, 0.0);
  const Points n = Vec3::UnitZ();
  const PhotonSumValues v = PhotonSum(s, 1.0, k, options, workers).evaluate(x, &n, workers);
  EXPECT_LT(std::abs(v.value[0] + k * v.normal_derivative[0]), 0.01 * v.value[0]);
}

// Documented: a point on a point charge has no finite value.
TEST(PhotonSum, PointChargesAreInfinite) {
  const Workers workers(1);
  const Points x = Vec3::Zero();
  const PhotonSumValues v =
      PhotonSum(one_charge(), 1.0, k, {}, workers).evaluate(x, nullptr, workers);
  EXPECT_FALSE(std::isfinite(v.value[0]));
}

TEST(PhotonSum, RefusesWhatItCannotDo) {
  const Workers workers(1);
  const PointSources good = layer(3, everywhere, false);
  EXPECT_THROW(PhotonSum(good, -1.0, k, {}, workers), std::invalid_argument);
  EXPECT_THROW(PhotonSum(good, 1.0, 0.0, {}, workers), std::invalid_argument);
  PhotonSumOptions options;
  options.tolerance = 1e-7;
  EXPECT_THROW(PhotonSum(good, 1.0, k, options, workers), std::invalid_argument);
  options.tolerance = 1e-2;
  options.softening = 2.0;
  EXPECT_THROW(PhotonSum(good, 1.0, k, options, workers), std::invalid_argument);
  PointSources bad = good;
  bad.strengths[1] = std::nan("");
  EXPECT_THROW(PhotonSum(bad, 1.0, k, {}, workers), std::invalid_argument);
  bad = good;
  bad.clear_heights.resize(2);
  EXPECT_THROW(PhotonSum(bad, 1.0, k, {}, workers), std::invalid_argument);
}

}  // namespace
}  // namespace knotlight
