// Radial solutions of (lap - lambda^2) u = 0 and the radial functions of dual reciprocity: values
// and derivatives with respect to r, safe at r = 0 by series.
#pragma once

namespace knotlight {

struct RadialValue {
  double value = 0.0;
  double derivative = 0.0;  // d/dr
};

// Non-singular solution exp(-lambda R) sinh(lambda r) / (lambda r), r in [0, R']: scaled so that it
// does not overflow. lambda = 0 gives 1. [V09 6.8, m = 0]
RadialValue nonsingular_solution(double r, double lambda, double R);

// Gaussian psi = exp(-r^2/c^2). [V09 6.17]
RadialValue gaussian(double r, double c);
// phi = (lap - lambda^2) psi = (4 r^2/c^4 - 6/c^2 - lambda^2) exp(-r^2/c^2). [V09 6.16]
double gaussian_helmholtz(double r, double c, double lambda);

}  // namespace knotlight
