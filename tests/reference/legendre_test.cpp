#include "reference/legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

double integral_of_power(const Quadrature& q, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < q.nodes.size(); ++i)
    sum += q.weights[i] * std::pow(q.nodes[i], power);
  return sum;
}

TEST(Legendre, PolynomialsAtAPoint) {
  const std::vector<double> p = legendre_polynomials(4, 0.3);
  EXPECT_DOUBLE_EQ(p[0], 1.0);
  EXPECT_DOUBLE_EQ(p[1], 0.3);
  EXPECT_NEAR(p[2], 0.5 * (3 * 0.09 - 1), 1e-15);
  EXPECT_NEAR(p[4], (35 * std::pow(0.3, 4) - 30 * 0.09 + 3) / 8, 1e-15);
}

// Exact up to the stated degree, and not beyond.
TEST(Legendre, QuadraturesAreExactToTheirDegree) {
  for (const int n : {1, 2, 5, 16}) {
    const Quadrature q = gauss_legendre(n);
    for (int power = 0; power <= 2 * n - 1; ++power)
      EXPECT_NEAR(integral_of_power(q, power), power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14);
    if (n <= 5) {
      EXPECT_GT(std::abs(integral_of_power(q, 2 * n) - 2.0 / (2 * n + 1)), 1e-4);
    }
  }
  for (const int n : {2, 3, 9}) {
    const Quadrature q = gauss_lobatto(n);
    EXPECT_EQ(q.nodes.front(), -1.0);
    EXPECT_EQ(q.nodes.back(), 1.0);
    for (int power = 0; power <= 2 * n - 3; ++power)
      EXPECT_NEAR(integral_of_power(q, power), power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace knotlight
