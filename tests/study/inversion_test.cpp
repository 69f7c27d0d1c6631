#include "study/inversion.h"

#include <gtest/gtest.h>

#include <limits>

namespace knotlight {
namespace {

constexpr double limit = 1.0 / std::numeric_limits<double>::epsilon();
constexpr int n = 7;
constexpr auto pinv = DenseMethod::svd, lu = DenseMethod::lu;

// Below the condition 2^52 the inverse is the pseudo-inverse.
TEST(Inversion, BothAreOneBelowTheLimit) {
  const double narrow = 0.35;
  const Inversion cut = inverted(n, narrow, pinv, pinv);
  ASSERT_LT(cut.source_condition, 1e-6 * limit);
  EXPECT_NEAR(inverted(n, narrow, lu, pinv).error / cut.error, 1.0, 1e-3);
}

// Beyond it the pseudo-inverse wins, by what the boundary matrix loses (measured: a factor 50).
TEST(Inversion, PseudoInverseWinsBeyondTheLimit) {
  const double wide = 2.0;
  const Inversion cut = inverted(n, wide, pinv, pinv);
  ASSERT_GT(cut.boundary_condition, limit);
  EXPECT_GT(inverted(n, wide, pinv, lu).error, 5.0 * cut.error);
  EXPECT_GT(inverted(n, wide, lu, lu).error, 5.0 * cut.error);
}

}  // namespace
}  // namespace knotlight
