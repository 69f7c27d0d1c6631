#include "core/asymptotic.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Nearer to 1 than this, kappa^2 = 3 (1 - c) (1 - 2/5 (1 - c)) to the last digits.
constexpr double nearly_one = 1e-7;

// The transient part beyond is below exp(-12) of the source.
constexpr double table_end = 12.0;
constexpr int table_steps = 240;  // linear between: 2e-4
constexpr int quadrature_points = 400;

double root(double albedo) {
  if (1.0 - albedo < nearly_one) return std::sqrt(3.0 * (1.0 - albedo));
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (albedo * std::atanh(middle) > middle ? high : low) = middle;
  }
  return low;
}

// g(c, mu) of [CdH53]: the weight of exp(-r / mu) in the transient part.
double transient_weight(double albedo, double mu) {
  const double real = 1.0 - albedo * mu * std::atanh(mu);
  const double imaginary = 0.5 * pi * albedo * mu;
  return 1.0 / (real * real + imaginary * imaginary);
}

// epsilon(r) = r exp(r) int_0^1 g(c, mu) exp(-r / mu) dmu / mu^2
//            = int_0^inf g(c, r / (r + x)) exp(-x) dx, with x = r / mu - r. The logarithm in g at
// x = 0 and the tail are smoothed by x = -log(1 - t^3), midpoint rule in t.
double epsilon_at(double albedo, double r) {
  if (r == 0.0) return 1.0;
  double sum = 0.0;
  for (int i = 0; i < quadrature_points; ++i) {
    const double t = (i + 0.5) / quadrature_points;
    const double x = -std::log1p(-t * t * t);
    sum += 3.0 * t * t * transient_weight(albedo, r / (r + x));
  }
  return sum / quadrature_points;
}

}  // namespace

PointSourceField PointSourceField::exact(double albedo) {
  assert(albedo >= 0.0 && albedo <= 1.0);
  PointSourceField field;
  const double kappa = root(albedo);
  field.kappa_ = kappa;
  // albedo = kappa / atanh(kappa), differentiated; its series where it is 0 / 0.
  if (kappa < 1e-2) {
    field.strength_ = 3.0 * (1.0 - 8.0 / 15.0 * kappa * kappa);
  } else if (kappa < 1.0) {
    const double a = std::atanh(kappa);
    field.strength_ = 2.0 * kappa * a * a / (kappa / (1.0 - kappa * kappa) - a);
  }
  for (int i = 0; i <= table_steps; ++i)
    field.epsilon_.push_back(epsilon_at(albedo, table_end * i / table_steps));
  return field;
}

PointSourceField PointSourceField::grosjean(double albedo) {
  assert(albedo >= 0.0 && albedo <= 1.0);
  PointSourceField field;
  field.kappa_ = std::sqrt(3.0 * (1.0 - albedo) / (2.0 - albedo));
  field.strength_ = 3.0 * albedo / (2.0 - albedo);
  field.epsilon_.assign(table_steps + 1, 1.0);
  return field;
}

double PointSourceField::epsilon(double distance) const {
  const double at = std::min(distance / table_end, 1.0) * table_steps;
  const auto i = std::min(static_cast<std::size_t>(at), epsilon_.size() - 2);
  const double part = at - static_cast<double>(i);
  return (1.0 - part) * epsilon_[i] + part * epsilon_[i + 1];
}

Medium asymptotic_medium(const Medium& medium, const PointSourceField& field) {
  assert(medium.g == 0.0);
  Medium p1 = medium;
  p1.sigma_a = field.kappa() * field.kappa() / 3.0 * medium.sigma_t();
  p1.sigma_s = medium.sigma_t() - p1.sigma_a;
  p1.emission = field.strength() / 3.0 * medium.emission;
  return p1;
}

double asymptotic_power(const Medium& medium, const PointSourceField& field) {
  return field.strength() / 3.0 * medium.albedo() / asymptotic_medium(medium, field).albedo();
}

}  // namespace knotlight
