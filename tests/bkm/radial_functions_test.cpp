#include "bkm/radial_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace knotlight {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double lambda = 1.3, c = 0.9;

std::vector<RadialFunction> all_functions() {
  std::vector<RadialFunction> all;
  for (const RadialKind kind :
       {RadialKind::linear, RadialKind::cubic, RadialKind::thin_plate, RadialKind::gaussian,
        RadialKind::compact_c0, RadialKind::compact_c2, RadialKind::compact_c4})
    all.push_back({kind, c, 1.0, 1, lambda, 2.0});
  for (const double exponent : {1.0, 2.5, 3.0})
    for (const RadialKind kind : {RadialKind::multiquadric, RadialKind::inverse_multiquadric})
      all.push_back({kind, c, exponent, 1, lambda, 2.0});
  for (int order = 1; order <= max_order; ++order)
    all.push_back({RadialKind::nonsingular, c, 1.0, order, lambda, 2.0});
  return all;
}

std::string name(const RadialFunction& w) {
  return "kind " + std::to_string(static_cast<int>(w.kind)) + " exponent " +
         std::to_string(w.exponent) + " order " + std::to_string(w.order);
}

Batch at(double r) {
  return Batch::Constant(1, r * r);
}
double psi(const RadialFunction& w, double r) {
  return psi_values(w, at(r))(0);
}

// Differences of fourth order in h; their errors fall 16-fold with half the step. Allowed: what the
// step below leaves of functions that vary over a length of 0.9, and rounding over h^2.
constexpr double step = 5e-3, difference_tolerance = 2e-6;

double first(const RadialFunction& w, double r) {
  return (8.0 * (psi(w, r + step) - psi(w, r - step)) -
          (psi(w, r + 2 * step) - psi(w, r - 2 * step))) /
         (12.0 * step);
}
double second(const RadialFunction& w, double r) {
  return (16.0 * (psi(w, r + step) + psi(w, r - step)) -
          (psi(w, r + 2 * step) + psi(w, r - 2 * step)) - 30.0 * psi(w, r)) /
         (12.0 * step * step);
}

// Inside and outside of the support of the compact ones, whose edge is at 0.9.
TEST(RadialFunctions, SlopeAndImageByDifferences) {
  for (const RadialFunction& w : all_functions())
    for (const double r : {0.2, 0.5, 0.8, 1.1, 3.0, 6.5}) {
      const RadialBatch v = psi_with_slopes(w, at(r));
      const double phi = phi_values(w, at(r))(0);
      const double size = std::abs(v.value(0)) + std::abs(phi) + 1.0 / (c * c);
      EXPECT_EQ(v.value(0), psi(w, r)) << name(w);
      EXPECT_NEAR(v.slope(0), first(w, r) / r, difference_tolerance * size) << name(w) << " " << r;
      EXPECT_NEAR(phi, second(w, r) + 2.0 / r * first(w, r) - lambda * lambda * v.value(0),
                  difference_tolerance * size)
          << name(w) << " at " << r;
    }
}

// phi(0) = 3 psi''(0) - lambda^2 psi(0), from the first terms of each psi.
TEST(RadialFunctions, LimitsAtZero) {
  const double l2 = lambda * lambda, c2 = c * c;
  const auto expect = [&](RadialKind kind, double exponent, int order, double value,
                          double curvature) {
    const RadialFunction w{kind, c, exponent, order, lambda, 0.0};
    for (const double r : {0.0, 1e-12}) {
      const RadialBatch v = psi_with_slopes(w, at(r));
      const double size = std::abs(value) + std::abs(curvature) + l2;
      EXPECT_NEAR(v.value(0), value, 1e-11 * size) << name(w);
      EXPECT_NEAR(v.slope(0), curvature, 1e-9 * size) << name(w);
      EXPECT_NEAR(phi_values(w, at(r))(0), 3.0 * curvature - l2 * value, 1e-9 * size) << name(w);
    }
  };
  expect(RadialKind::linear, 1.0, 1, 0.0, 0.0);
  expect(RadialKind::cubic, 1.0, 1, 0.0, 0.0);
  expect(RadialKind::thin_plate, 1.0, 1, 0.0, 0.0);
  expect(RadialKind::gaussian, 1.0, 1, 1.0, -2.0 / c2);
  expect(RadialKind::multiquadric, 1.0, 1, 1.0, 1.0 / c2);
  expect(RadialKind::inverse_multiquadric, 3.0, 1, 1.0, -3.0 / c2);
  expect(RadialKind::compact_c0, 1.0, 1, -1.0 / 12.0, 1.0 / (3.0 * c2));
  expect(RadialKind::compact_c2, 1.0, 1, 1.0, -20.0 / c2);
  expect(RadialKind::compact_c4, 1.0, 1, 3.0, -56.0 / c2);
  // U_m = (r^2/2)^m / (m! (2m+1)!!) near 0.
  expect(RadialKind::nonsingular, 1.0, 1, 0.0, 1.0 / 3.0);
  expect(RadialKind::nonsingular, 1.0, 2, 0.0, 0.0);
}

// Where the supports end psi, its slope and, but for compact_c0, phi have no jump.
TEST(RadialFunctions, CompactOnesEndSmoothly) {
  constexpr double next_to = 1e-9;
  for (const RadialKind kind :
       {RadialKind::compact_c0, RadialKind::compact_c2, RadialKind::compact_c4}) {
    const RadialFunction w{kind, c, 1.0, 1, lambda, 1.0};
    const RadialBatch in = psi_with_slopes(w, at(c * (1.0 - next_to)));
    const RadialBatch out = psi_with_slopes(w, at(c * (1.0 + next_to)));
    EXPECT_NEAR(in.value(0), out.value(0), 1e-8);
    EXPECT_NEAR(in.slope(0), out.slope(0), 1e-8);
    EXPECT_NEAR(phi_values(w, at(c * (1.0 - next_to)))(0),
                phi_values(w, at(c * (1.0 + next_to)))(0), 1e-8);
    if (kind == RadialKind::compact_c0) continue;
    EXPECT_EQ(psi(w, 1.01 * c), 0.0);
    EXPECT_EQ(phi_values(w, at(1.01 * c))(0), 0.0);
  }
}

// i_m by its power series in extended precision.
long double bessel_i(int m, long double x) {
  long double term = 1.0L;
  for (int j = 1; j <= m; ++j) term *= x / (2.0L * j + 1.0L);
  long double sum = term;
  for (int k = 1; k < 400; ++k) sum += term *= x * x / (2.0L * k * (2.0L * k + 2.0L * m + 1.0L));
  return sum;
}

TEST(RadialFunctions, HigherOrdersHaveTheirDigits) {
  // Rounding of the exponent, and what the recurrence upwards loses right above its limit.
  constexpr double allowed = 100.0 * epsilon;
  for (int m = 0; m <= max_order; ++m)
    for (double x = 1e-6; x < 100.0; x *= 1.3) {
      const double r = x / lambda;
      const RadialFunction w{RadialKind::nonsingular, 1.0, 1.0, m, lambda, r};
      const long double lx = static_cast<long double>(lambda) * r;
      long double power = std::exp(-lx);
      for (int j = 1; j <= m; ++j) power *= r / (2.0L * lambda * j);
      const RadialBatch v = psi_with_slopes(w, at(r));
      EXPECT_NEAR(v.value(0) / static_cast<double>(power * bessel_i(m, lx)), 1.0,
                  allowed + epsilon * x)
          << m << " " << x;
      // (x^m i_m)' = x^m i_(m-1) - x^(m-1) i_m, with i_(-1) = cosh x / x.
      const long double before = m > 0 ? bessel_i(m - 1, lx) : std::cosh(lx) / lx;
      if (x < 1.0) continue;  // there this form loses digits
      EXPECT_NEAR(
          v.slope(0) * r / static_cast<double>(lambda * power * (before - bessel_i(m, lx) / lx)),
          1.0, allowed + epsilon * x)
          << m << " " << x;
    }
}

TEST(RadialFunctions, OrderWithoutAbsorption) {
  // lambda = 0: r^(2m) / (2m+1)!.
  for (const double r : {0.0, 0.4, 7.0}) {
    EXPECT_NEAR(psi({RadialKind::nonsingular, 1.0, 1.0, 1, 0.0, 3.0}, r), r * r / 6.0,
                1e-14 * (1.0 + r * r));
    EXPECT_NEAR(psi({RadialKind::nonsingular, 1.0, 1.0, 2, 0.0, 3.0}, r), std::pow(r, 4) / 120.0,
                1e-14 * (1.0 + std::pow(r, 4)));
  }
}

TEST(RadialFunctions, NaNStaysWhereItIs) {
  for (const RadialFunction& w : all_functions()) {
    Batch s(5);
    s << 0.1, 4.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 90.0;
    const RadialBatch v = psi_with_slopes(w, s);
    for (const Batch& out : {v.value, v.slope, phi_values(w, s)}) {
      EXPECT_TRUE(std::isnan(out(2))) << name(w);
      EXPECT_TRUE(out.head(2).allFinite() && out.tail(2).allFinite()) << name(w);
    }
  }
}

TEST(RadialFunctions, DistancesInFloat) {
  Points p(3, 1);
  p << 0.1, 0.2, 0.3;
  const Vec3 x(1.0 / 3.0, 0.7, 0.9);
  const double exact = squared_distances(point_columns(p), 0, 1, x)(0);
  const double rounded =
      squared_distances(point_columns(p), 0, 1, x, DistancePrecision::single_precision)(0);
  const float dx = 0.1F - 1.0F / 3.0F, dy = 0.2F - 0.7F, dz = 0.3F - 0.9F;
  const float r = std::sqrt(dx * dx + dy * dy + dz * dz);
  constexpr double float_epsilon = 6e-8;
  EXPECT_NEAR(rounded, exact, 8.0 * float_epsilon * exact);
  EXPECT_NEAR(rounded, static_cast<double>(r) * r, 4.0 * float_epsilon * exact);
  EXPECT_EQ(std::sqrt(rounded), static_cast<float>(std::sqrt(rounded)));
}

}  // namespace
}  // namespace knotlight
