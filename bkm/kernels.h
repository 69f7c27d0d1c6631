// Radial solutions of (lap - lambda^2) u = 0 and the radial functions of dual reciprocity: values
// and derivatives with respect to r, safe at r = 0 by series. One at a time; kernel_batch.h has the
// same functions for many distances at once.
#pragma once

namespace knotlight {

// Below lambda r = 1 the closed form of i_1 loses digits to cancellation, (x cosh x - sinh x) /
// x^2; from there on it loses less than one.
inline constexpr double series_limit = 1.0;
// Terms of sum_k x^(2k+1) (2k+2) / (2k+3)!: at x = 1 the first one left out is 1e-18 of the sum.
inline constexpr int series_terms = 9;

struct RadialValue {
  double value = 0.0;
  double derivative = 0.0;  // d/dr
};

// Non-singular solution exp(-lambda R) sinh(lambda r) / (lambda r), r >= 0: the scale keeps it from
// overflow for r up to R + 700 / lambda. lambda = 0 gives 1. r, R: length; lambda: 1/length.
// [V09 6.8, m = 0], without its factor sqrt(2/pi) and with the scale that [V09 ch. 6.1] proposes.
RadialValue nonsingular_solution(double r, double lambda, double R);

// Gaussian psi = exp(-r^2/c^2), c > 0: length. [V09 6.17]
RadialValue gaussian(double r, double c);
// phi = (lap - lambda^2) psi = (4 r^2/c^4 - 6/c^2 - lambda^2) exp(-r^2/c^2), 1/length^2. [V09 6.16]
double gaussian_helmholtz(double r, double c, double lambda);

}  // namespace knotlight
