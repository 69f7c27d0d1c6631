#include "reference/ball_p1.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace knotlight {
namespace {

using std::numbers::pi;

// sinh(x)/x and its derivative; the series' next terms are below 1e-16.
constexpr double small_argument = 1e-3;
double i0(double x) {
  return x < small_argument ? 1.0 + x * x / 6.0 + x * x * x * x / 120.0 : std::sinh(x) / x;
}
double i0_slope(double x) {
  return x < small_argument ? x / 3.0 + x * x * x / 30.0 : (std::cosh(x) - std::sinh(x) / x) / x;
}

// Below it the limit is off by less than 1e-8, above it the difference from 1 loses less than that.
constexpr double nearly_no_absorption = 1e-4;

// Exponential integral E1(x) = int_x^inf e^-t / t dt, x > 0.
double E1(double x) {
  return -std::expint(-x);
}

}  // namespace

GlowingBallP1::GlowingBallP1(const Medium& medium, Boundary boundary, double radius)
    : medium_(medium), c_(p1_constants(medium, boundary)), radius_(radius) {}

// lap U - lambda^2 U = -s with s = 3 sigma_tr E / (4 pi): U = s / lambda^2 - C i0(lambda r), and C
// from U + k U' = 0 at R. In the limit lambda -> 0, U = s ((R^2 - r^2) / 6 + k R / 3).
double GlowingBallP1::U_d(double r) const {
  const double s = -c_.per_E * medium_.emission;
  const double lambda = c_.lambda;
  if (lambda * radius_ < nearly_no_absorption)
    return s * ((radius_ * radius_ - r * r) / 6.0 + c_.k * radius_ / 3.0);
  const double at_surface = i0(lambda * radius_) + c_.k * lambda * i0_slope(lambda * radius_);
  return s / (lambda * lambda) * (1.0 - i0(lambda * r) / at_surface);
}

double GlowingBallP1::power_leaving() const {
  return 4.0 * pi * radius_ * radius_ * c_.out_per_U * U_d(radius_);
}

double GlowingBallP1::power_absorbed() const {
  return 4.0 / 3.0 * pi * std::pow(radius_, 3) * medium_.emission - power_leaving();
}

// U_ri = e^(-sigma_t r) / (16 pi^2 r^2), and Q_ri = g sigma_s e^(-sigma_t r) / (4 pi r^2) outwards.
// Away from the lamp div Q_ri = -4 pi g sigma_s sigma_t U_ri as everywhere; at the lamp the light
// begins, which adds g sigma_s delta(x). So
//   f = -3 sigma_s (sigma_tr + g sigma_t) U_ri + (3 / 4 pi) g sigma_s delta(x).
LampInBallP1::LampInBallP1(const Medium& medium, Boundary boundary, double radius)
    : medium_(medium), c_(p1_constants(medium, boundary)), radius_(radius) {
  if (!(c_.lambda > 0.0) || !(c_.lambda < medium.sigma_t()))
    throw std::domain_error("LampInBallP1: expected 0 < lambda < sigma_t");
  const Value p = particular(radius);
  const double Q = medium.g * medium.sigma_s * std::exp(-medium.sigma_t() * radius) /
                   (4.0 * pi * radius * radius);
  const double x = c_.lambda * radius;
  homogeneous_ = (c_.per_Q * Q - p.u - c_.k * p.slope) / (i0(x) + c_.k * c_.lambda * i0_slope(x));
}

// The solution in infinite space. A shell of radius s and unit strength gives
// e^(-lambda r>) sinh(lambda r<) / (4 pi lambda r s) (r>, r< the larger and smaller of r and s), so
// with f = -K e^(-sigma_t s)/s^2 the shells give K / (lambda r) times
//   e^(-lambda r) a + sinh(lambda r) b,   a = int_0^r   e^(-sigma_t s) sinh(lambda s) / s ds,
//                                         b = int_r^inf e^(-(sigma_t + lambda) s) / s ds,
// both exponential integrals. In the slope the derivatives of a and b cancel. The delta gives
// -(3/4pi) g sigma_s e^(-lambda r) / (4 pi r).
LampInBallP1::Value LampInBallP1::particular(double r) const {
  const double lambda = c_.lambda;
  const double plus = medium_.sigma_t() + lambda;
  const double minus = medium_.sigma_t() - lambda;
  const double a = 0.5 * (E1(plus * r) - E1(minus * r) + std::log(plus / minus));
  const double b = E1(plus * r);
  const double falling = std::exp(-lambda * r);
  const double K = -c_.per_U_ri / (16.0 * pi * pi);
  const double shells = K / lambda * (falling * a + std::sinh(lambda * r) * b);
  const double shells_slope = K * (std::cosh(lambda * r) * b - falling * a);
  const double lamp = -3.0 / (16.0 * pi * pi) * medium_.g * medium_.sigma_s * falling;
  const double u = (shells + lamp) / r;
  return {u, (shells_slope - lambda * lamp - u) / r};
}

double LampInBallP1::U_ri(double r) const {
  return std::exp(-medium_.sigma_t() * r) / (16.0 * pi * pi * r * r);
}

double LampInBallP1::U_d(double r) const {
  return particular(r).u + homogeneous_ * i0(c_.lambda * r);
}

double LampInBallP1::power_leaving() const {
  return 4.0 * pi * radius_ * radius_ * c_.out_per_U * U_d(radius_);
}

double LampInBallP1::power_in() const {
  return -std::expm1(-medium_.sigma_t() * radius_);
}

double LampInBallP1::power_absorbed() const {
  return medium_.albedo() * power_in() - power_leaving();
}

}  // namespace knotlight
