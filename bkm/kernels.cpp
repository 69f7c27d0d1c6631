#include "bkm/kernels.h"

#include <cmath>

namespace knotlight {
namespace {

// Modified spherical Bessel function i_1(x) [V09 6.9, m = 1] for small x, where
// x^(2k+3)/(2k+2)! - x^(2k+3)/(2k+3)! = x^(2k+3) (2k+2)/(2k+3)!.
double i1_series(double x) {
  double term = x / 3.0;
  double sum = term;
  for (int k = 1; k < series_terms; ++k) {
    term *= x * x / (2.0 * k * (2.0 * k + 3.0));
    sum += term;
  }
  return sum;
}

}  // namespace

RadialValue nonsingular_solution(double r, double lambda, double R) {
  const double x = lambda * r;
  if (x == 0.0) return {std::exp(-lambda * R), 0.0};
  // sinh x = exp(x) (1 - exp(-2x)) / 2: expm1 keeps all digits, and exp(x) joins the scale.
  const double grown = std::exp(x - lambda * R);
  const double one_minus = -std::expm1(-2.0 * x);
  const double value = grown * one_minus / (2.0 * x);
  if (x < series_limit) return {value, lambda * std::exp(-lambda * R) * i1_series(x)};
  return {value, lambda * grown * (x * (2.0 - one_minus) - one_minus) / (2.0 * x * x)};
}

RadialValue gaussian(double r, double c) {
  const double value = std::exp(-(r / c) * (r / c));
  return {value, -2.0 * r / (c * c) * value};
}

double gaussian_helmholtz(double r, double c, double lambda) {
  const double s = (r / c) * (r / c);
  return ((4.0 * s - 6.0) / (c * c) - lambda * lambda) * std::exp(-s);
}

}  // namespace knotlight
