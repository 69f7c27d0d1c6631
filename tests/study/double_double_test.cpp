#include "study/double_double.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "core/rng.h"

namespace knotlight {
namespace {

const double unit = std::ldexp(1.0, -104);

DoubleDouble some(std::uint64_t index) {
  Rng rng(1, Stream::tests, index);
  return DoubleDouble::quick_sum(0.5 + rng.uniform(), std::ldexp(rng.uniform() - 0.5, -54));
}

// 1/3 has the digit 1 at every other place: 2^-2 + 2^-4 + ...
TEST(DoubleDouble, HasTwiceTheDigits) {
  DoubleDouble third = 0.0;
  for (int i = 2; i <= 110; i += 2) third += std::ldexp(1.0, -i);
  const DoubleDouble divided = DoubleDouble(1.0) / DoubleDouble(3.0);
  EXPECT_LT(abs(divided - third).hi, unit);
  EXPECT_NE(divided.lo, 0.0);
  EXPECT_EQ((DoubleDouble(1.0) + DoubleDouble(1e-30) - DoubleDouble(1.0)).hi, 1e-30);
}

TEST(DoubleDouble, OperationsUndoEachOther) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const DoubleDouble a = some(2 * i), b = some(2 * i + 1), root = sqrt(a);
    EXPECT_LT(abs(a / b * b - a).hi, 4.0 * unit);
    EXPECT_LT(abs(a + b - b - a).hi, 4.0 * unit);
    EXPECT_LT(abs(root * root - a).hi, 4.0 * unit);
    EXPECT_LT(abs((a + b) * (a - b) - (a * a - b * b)).hi, 16.0 * unit);
  }
  EXPECT_EQ(sqrt(DoubleDouble(0.0)).hi, 0.0);
}

// Hilbert's matrix of size 12 has a condition of 1.8e16: nothing is left of double's digits.
TEST(DoubleDouble, EigenFactorsWithIt) {
  constexpr int n = 12;
  Eigen::Matrix<DoubleDouble, Eigen::Dynamic, Eigen::Dynamic> a(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a(i, j) = DoubleDouble(1.0) / DoubleDouble(i + j + 1.0);
  const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1> ones =
      Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>::Constant(n, DoubleDouble(1.0));
  const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1> x = a.colPivHouseholderQr().solve(a * ones);
  for (int i = 0; i < n; ++i) EXPECT_LT(abs(x[i] - DoubleDouble(1.0)).hi, 1e-12);
}

}  // namespace
}  // namespace knotlight
