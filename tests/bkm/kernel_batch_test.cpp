#include "bkm/kernel_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bkm/kernels.h"
#include "core/rng.h"

namespace knotlight {
namespace {

// The vector exponential is good to about two units in the last place, the rest as in kernels.h.
constexpr double relative = 16.0 * std::numeric_limits<double>::epsilon();

// Distances from 1e-8 to 30, so that lambda r = 1 is crossed inside a batch.
Batch squares(Eigen::Index n, double largest) {
  Batch s(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Rng rng(3, Stream::tests, static_cast<std::uint64_t>(i));
    s(i) = std::pow(largest * std::pow(rng.uniform(), 4.0), 2.0);
  }
  if (n > 1) s(1) = 0.0;
  return s;
}

TEST(KernelBatch, AgreesWithOneAtATime) {
  const double c = 1.4, R = 3.0;
  for (const double lambda : {0.0, 0.02, 1.0, 6.0})
    for (const Eigen::Index n : {1, 3, 64, 101, 128})
      for (const double largest : {0.1, 3.0, 12.0}) {
        const Batch s = squares(n, largest);
        const Batch G = nonsingular_values(s, lambda, R);
        const RadialBatch Gs = nonsingular_solutions(s, lambda, R);
        const Batch psi = gaussian_values(s, c);
        const RadialBatch psis = gaussians(s, c);
        const Batch phi = gaussian_helmholtz_values(s, c, lambda);
        for (Eigen::Index i = 0; i < n; ++i) {
          const double r = std::sqrt(s(i));
          // The exponent lambda (r - R) or r^2/c^2 is rounded before it is raised.
          const double allowed = relative * (1.0 + lambda * (r + R) + s(i) / (c * c));
          const RadialValue w = nonsingular_solution(r, lambda, R);
          EXPECT_NEAR(G(i), w.value, allowed * w.value);
          EXPECT_EQ(Gs.value(i), G(i));
          EXPECT_NEAR(Gs.slope(i) * r, w.derivative, allowed * w.derivative);
          const RadialValue v = gaussian(r, c);
          EXPECT_NEAR(psi(i), v.value, allowed * v.value);
          EXPECT_EQ(psis.value(i), psi(i));
          EXPECT_NEAR(psis.slope(i) * r, v.derivative, allowed * std::abs(v.derivative));
          // phi crosses zero: measured against the size of its terms.
          const double size = (4.0 * s(i) / (c * c) + 6.0) / (c * c) + lambda * lambda;
          EXPECT_NEAR(phi(i), gaussian_helmholtz(r, c, lambda), allowed * size * v.value);
        }
      }
}

TEST(KernelBatch, SlopeAtZeroIsTheLimit) {
  const Batch zero = Batch::Zero(1);
  EXPECT_NEAR(nonsingular_solutions(zero, 3.0, 0.0).slope(0), 3.0, 3.0 * relative);  // lambda^2/3
  EXPECT_NEAR(gaussians(zero, 0.5).slope(0), -8.0, 8.0 * relative);                  // -2/c^2
}

TEST(KernelBatch, FarBeyondOverflow) {
  const Batch s = squares(100, 1.0);
  const RadialBatch w = nonsingular_solutions(s, 1e5, 1.0);
  EXPECT_TRUE(w.value.allFinite() && w.slope.allFinite());
}

TEST(KernelBatch, NaNStaysWhereItIs) {
  for (const double largest : {0.1, 12.0}) {
    Batch s = squares(20, largest);
    s(13) = std::numeric_limits<double>::quiet_NaN();
    for (const Batch& w :
         {nonsingular_values(s, 1.0, 3.0), nonsingular_solutions(s, 1.0, 3.0).slope,
          gaussian_values(s, 1.0), gaussian_helmholtz_values(s, 1.0, 1.0)}) {
      EXPECT_TRUE(std::isnan(w(13)));
      EXPECT_TRUE(w.head(13).allFinite() && w.tail(6).allFinite());
    }
  }
}

TEST(KernelBatch, SquaredDistances) {
  Points p(3, 5);
  for (int i = 0; i < 5; ++i) p.col(i) = Vec3(0.3 * i, 1.0 - i, 0.1 * i * i);
  const Vec3 x(0.2, -0.4, 2.0);
  const Batch s = squared_distances(point_columns(p), 1, 3, x);
  ASSERT_EQ(s.size(), 3);
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_NEAR(s(i), (p.col(i + 1) - x).squaredNorm(), relative * s(i));
}

}  // namespace
}  // namespace knotlight
