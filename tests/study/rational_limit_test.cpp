#include "study/rational_limit.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

// Poles in common, two of them inside the circle, and a numerator that never ends.
std::complex<double> function(double i, std::complex<double> z) {
  return std::exp(i * z) / ((z + 0.5) * (z + 0.8) * (z + 1.7)) + i;
}

TEST(RationalLimit, FindsTheValuesInsideFromTheCircle) {
  constexpr int count = 20;
  const Eigen::VectorXcd circle = half_circle(16);
  Eigen::MatrixXcd on_circle(count, circle.size());
  for (int i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < circle.size(); ++j) on_circle(i, j) = function(0.1 * i, circle[j]);
  for (const double z : {0.0, 0.3, -0.2}) {
    const Eigen::VectorXd u = rational_limit(on_circle, z);
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(u[i], function(0.1 * i, z).real(), 1e-10) << i << ' ' << z;
  }
}

}  // namespace
}  // namespace knotlight
