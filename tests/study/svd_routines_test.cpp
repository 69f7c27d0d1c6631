#include "study/svd_routines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace knotlight {
namespace {

// A smooth kernel at 120 points of a line: its singular values fall to rounding.
Eigen::MatrixXd smooth_kernel() {
  const Eigen::Index n = 120;
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double r = static_cast<double>(i - j) / static_cast<double>(n);
      a(i, j) = std::exp(-r * r) * (1.0 + 0.1 * static_cast<double>(i % 2));
    }
  return a;
}

// Each is backward stable: residuals of some n eps, each with its own eps; all in one precision
// keep as many values, and float fewer than double.
TEST(SvdRoutines, AgreeToTheirPrecision) {
  const Eigen::MatrixXd a = smooth_kernel();
  const double n = static_cast<double>(a.rows());
  int in_float = 0, in_double = 0;
  for (const SvdRoutine routine : svd_routines()) {
    const SvdRun run = run_svd(routine, a);
    const bool single = name_of(routine)[0] == 's' && routine != SvdRoutine::sampled;
    const double eps = single ? static_cast<double>(std::numeric_limits<float>::epsilon())
                              : std::numeric_limits<double>::epsilon();
    EXPECT_LT(run.residual, n * eps) << name_of(routine);
    EXPECT_GE(run.seconds, 0.0);
    int& kept = single ? in_float : in_double;
    if (kept == 0) kept = run.kept;
    EXPECT_EQ(run.kept, kept) << name_of(routine);
  }
  EXPECT_LT(in_float, in_double);
  EXPECT_GT(in_float, 0);
}

}  // namespace
}  // namespace knotlight
