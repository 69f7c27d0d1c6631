#include "reference/legendre.h"

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

constexpr int newton_steps = 20;  // quadratic convergence from guesses good to 1e-2: 6 suffice

// P_n and P_n' at |x| < 1.
struct ValueAndSlope {
  double p, slope;
};
ValueAndSlope legendre(int n, double x) {
  const std::vector<double> p = legendre_polynomials(n, x);
  const double last = p[static_cast<std::size_t>(n)];
  const double before = n > 0 ? p[static_cast<std::size_t>(n) - 1] : 0.0;
  return {last, n * (x * last - before) / (x * x - 1.0)};
}

}  // namespace

// (n + 1) P_(n+1) = (2 n + 1) x P_n - n P_(n-1).
std::vector<double> legendre_polynomials(int degree, double x) {
  std::vector<double> p(static_cast<std::size_t>(degree) + 1, 1.0);
  if (degree >= 1) p[1] = x;
  for (int n = 1; n < degree; ++n) {
    const auto i = static_cast<std::size_t>(n);
    p[i + 1] = ((2 * n + 1) * x * p[i] - n * p[i - 1]) / (n + 1);
  }
  return p;
}

// Zeros of P_n by Newton's method; weights 2 / ((1 - x^2) P_n'(x)^2).
Quadrature gauss_legendre(int n) {
  Quadrature q;
  for (int i = n; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    for (int step = 0; step < newton_steps; ++step) {
      const ValueAndSlope v = legendre(n, x);
      x -= v.p / v.slope;
    }
    const double slope = legendre(n, x).slope;
    q.nodes.push_back(x);
    q.weights.push_back(2.0 / ((1.0 - x * x) * slope * slope));
  }
  return q;
}

// The ends and the zeros of P_(n-1)', whose own slope follows from Legendre's equation
// (1 - x^2) P'' = 2 x P' - N (N + 1) P; weights 2 / (n (n - 1) P_(n-1)^2).
Quadrature gauss_lobatto(int n) {
  Quadrature q;
  const int degree = n - 1;
  const double end_weight = 2.0 / (n * degree);
  q.nodes.push_back(-1.0);
  q.weights.push_back(end_weight);
  for (int i = degree - 1; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * i / degree);
    for (int step = 0; step < newton_steps; ++step) {
      const ValueAndSlope v = legendre(degree, x);
      x -= v.slope * (1.0 - x * x) / (2.0 * x * v.slope - degree * (degree + 1) * v.p);
    }
    const double p = legendre(degree, x).p;
    q.nodes.push_back(x);
    q.weights.push_back(end_weight / (p * p));
  }
  q.nodes.push_back(1.0);
  q.weights.push_back(end_weight);
  return q;
}

}  // namespace knotlight
