// Legendre polynomials and the quadratures built on them.
#pragma once

#include <vector>

namespace knotlight {

// P_0(x) ... P_degree(x), |x| <= 1.
std::vector<double> legendre_polynomials(int degree, double x);

struct Quadrature {
  std::vector<double> nodes, weights;  // on [-1, 1], increasing; weights add up to 2
};
// n points, exact for polynomials of degree 2 n - 1.
Quadrature gauss_legendre(int n);
// n >= 2 points with both ends among them, exact for degree 2 n - 3: the nodes of spectral
// elements.
Quadrature gauss_lobatto(int n);

}  // namespace knotlight
