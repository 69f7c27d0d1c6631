#include "bkm/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace knotlight {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// A few roundings per kernel: the exponential, the difference and two or three products.
constexpr double roundings = 12.0 * epsilon;

// sinh(x)/x and i_1(x) = (x cosh x - sinh x)/x^2 times exp(-x) in extended precision: the power
// series below x = 4, where all its terms are positive, closed forms above.
long double scaled_i0(long double x) {
  if (x > 4.0L) return (1.0L - std::exp(-2.0L * x)) / (2.0L * x);
  long double term = 1.0L, sum = 1.0L;
  for (int k = 1; k < 40; ++k) sum += term *= x * x / (2.0L * k * (2.0L * k + 1.0L));
  return sum * std::exp(-x);
}
long double scaled_i1(long double x) {
  if (x > 4.0L) return ((x - 1.0L) + (x + 1.0L) * std::exp(-2.0L * x)) / (2.0L * x * x);
  long double term = x / 3.0L, sum = term;
  for (int k = 1; k < 40; ++k) sum += term *= x * x / (2.0L * k * (2.0L * k + 3.0L));
  return sum * std::exp(-x);
}

TEST(Kernels, NonsingularSolutionHasAllDigits) {
  for (const double lambda : {0.03, 1.0, 40.0})
    for (double x = 1e-9; x < 600.0; x *= 1.37) {
      const double r = x / lambda, R = r * 1.25;
      const RadialValue w = nonsingular_solution(r, lambda, R);
      const long double scale =
          std::exp(static_cast<long double>(lambda) * r - static_cast<long double>(lambda) * R);
      const long double lr = static_cast<long double>(lambda) * r;
      // The argument lambda r - lambda R is itself rounded.
      const double allowed = roundings + 2.0 * epsilon * lambda * R;
      EXPECT_NEAR(w.value / static_cast<double>(scale * scaled_i0(lr)), 1.0, allowed) << x;
      EXPECT_NEAR(w.derivative / static_cast<double>(lambda * scale * scaled_i1(lr)), 1.0, allowed)
          << x;
    }
}

TEST(Kernels, NonsingularSolutionAtZero) {
  const RadialValue w = nonsingular_solution(0.0, 2.0, 1.5);
  EXPECT_DOUBLE_EQ(w.value, std::exp(-3.0));
  EXPECT_EQ(w.derivative, 0.0);
  // w'(r) -> lambda^2 r / 3.
  const double r = 1e-12;
  EXPECT_NEAR(nonsingular_solution(r, 2.0, 1.5).derivative / (std::exp(-3.0) * 4.0 * r / 3.0), 1.0,
              roundings);
}

TEST(Kernels, NonsingularSolutionWithoutAbsorptionIsOne) {
  for (const double r : {0.0, 0.3, 7.0}) {
    EXPECT_EQ(nonsingular_solution(r, 0.0, 5.0).value, 1.0);
    EXPECT_EQ(nonsingular_solution(r, 0.0, 5.0).derivative, 0.0);
  }
}

TEST(Kernels, NonsingularSolutionDoesNotOverflow) {
  constexpr double lambda_R = 1e5;
  for (const double r : {0.0, 1e-6, 0.5, 0.999, 1.0}) {
    const RadialValue w = nonsingular_solution(r, lambda_R, 1.0);
    EXPECT_TRUE(std::isfinite(w.value) && std::isfinite(w.derivative)) << r;
  }
  EXPECT_NEAR(nonsingular_solution(1.0, lambda_R, 1.0).value * 2.0 * lambda_R, 1.0, roundings);
  // (x - 1) / (2 x^2) times lambda at x = 1e5.
  EXPECT_NEAR(nonsingular_solution(1.0, lambda_R, 1.0).derivative / (0.5 * (1.0 - 1e-5)), 1.0,
              roundings);
}

// Errors of central differences fall four-fold when the step is halved.
constexpr double rate = 4.0;
constexpr double rate_slack = 0.1;  // the next term of the error series at these steps

template <typename W>
void expect_derivative(const W& w, double r) {
  const auto error = [&](double h) {
    return (w(r + h).value - w(r - h).value) / (2.0 * h) - w(r).derivative;
  };
  EXPECT_NEAR(error(2e-2) / error(1e-2), rate, rate_slack) << r;
}

// w'' + 2 w'/r by differences [V09 6.15] against lap w as claimed.
template <typename W>
void expect_laplacian(const W& w, double claimed, double r) {
  const auto error = [&](double h) {
    return (w(r + h).value - 2.0 * w(r).value + w(r - h).value) / (h * h) +
           (w(r + h).value - w(r - h).value) / (r * h) - claimed;
  };
  EXPECT_NEAR(error(4e-2) / error(2e-2), rate, rate_slack) << r;
}

TEST(Kernels, NonsingularSolutionSolvesTheEquation) {
  const auto w = [](double r) { return nonsingular_solution(r, 1.7, 2.0); };
  for (const double r : {0.2, 0.55, 0.62, 1.9}) {  // 1/1.7 = 0.588: on both sides of the series
    expect_derivative(w, r);
    expect_laplacian(w, 1.7 * 1.7 * w(r).value, r);
  }
}

TEST(Kernels, GaussianAndItsImage) {
  const double lambda = 1.3, c = 0.8;
  const auto w = [&](double r) { return gaussian(r, c); };
  for (const double r : {0.3, 0.9, 1.6}) {
    expect_derivative(w, r);
    expect_laplacian(w, gaussian_helmholtz(r, c, lambda) + lambda * lambda * w(r).value, r);
  }
  EXPECT_EQ(gaussian(0.0, c).value, 1.0);
  EXPECT_EQ(gaussian(0.0, c).derivative, 0.0);
  EXPECT_DOUBLE_EQ(gaussian_helmholtz(0.0, c, lambda), -6.0 / (c * c) - lambda * lambda);
  EXPECT_EQ(gaussian(1e3, c).value, 0.0);
}

TEST(Kernels, KeepNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(nonsingular_solution(nan, 1.0, 1.0).value));
  EXPECT_TRUE(std::isnan(gaussian(nan, 1.0).value));
  EXPECT_TRUE(std::isnan(gaussian_helmholtz(nan, 1.0, 1.0)));
}

}  // namespace
}  // namespace knotlight
