#include "bkm/spectral.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "bkm/assembly.h"
#include "bkm/bkm_cases.h"
#include "bkm/lapack.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

Eigen::MatrixXd orthonormal(Eigen::Index n, std::uint64_t stream) {
  Eigen::MatrixXd a(n, n);
  Rng rng(31, Stream::tests, stream);
  for (double& x : a.reshaped()) x = 2.0 * rng.uniform() - 1.0;
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ();
}

// Singular values that fall by `factor` each, with alternating signs on the symmetric one.
Eigen::MatrixXd decaying(Eigen::Index n, double factor, bool symmetric) {
  const Eigen::MatrixXd u = orthonormal(n, 1);
  Eigen::VectorXd s(n);
  for (Eigen::Index i = 0; i < n; ++i) s(i) = 3.0 * std::pow(factor, static_cast<double>(i));
  if (!symmetric) return u * s.asDiagonal() * orthonormal(n, 2).transpose();
  for (Eigen::Index i = 1; i < n; i += 2) s(i) = -s(i);
  const Eigen::MatrixXd a = u * s.asDiagonal() * u.transpose();
  return 0.5 * (a + a.transpose());
}

constexpr double cut = 1e-11;

// Rounding of the decomposition against values down to the cut.
constexpr double value_tolerance = 1e-14;

TEST(Spectral, FindsAllAboveTheCut) {
  for (const bool symmetric : {true, false})
    for (const double factor : {0.8, 0.99}) {  // rank 114: compressed; all 600: in full
      const Eigen::MatrixXd a = decaying(600, factor, symmetric);
      const SpectralFactors f = spectral_factors(a, cut, Workers(1));
      ASSERT_TRUE(f.message.empty());
      EXPECT_EQ(f.complete, factor == 0.99);
      EXPECT_LT(f.s.size(), factor == 0.99 ? 601 : 300);
      for (Eigen::Index i = 0; i < f.s.size() && f.s(i) > cut * f.s(0); ++i)
        EXPECT_NEAR(f.s(i), 3.0 * std::pow(factor, static_cast<double>(i)), 3.0 * value_tolerance)
            << i;
      EXPECT_LE(f.s(f.s.size() - 1), f.complete ? f.s(0) : cut * f.s(0));
      const Eigen::MatrixXd left = a - f.u * f.s.asDiagonal() * f.v.transpose();
      EXPECT_LT(left.cwiseAbs().maxCoeff(), cut * f.s(0));
      const auto identity = Eigen::MatrixXd::Identity(f.s.size(), f.s.size());
      EXPECT_LT((f.u.transpose() * f.u - identity).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((f.v.transpose() * f.v - identity).cwiseAbs().maxCoeff(), 1e-12);
    }
}

// The matrix of the method itself, against LAPACK's full decomposition.
TEST(Spectral, SameRankAsTheFullDecomposition) {
  const RadialFunction w{RadialKind::gaussian, 2.0, 1.0, 1, 2.0, 2.0};
  Eigen::MatrixXd phi = source_matrix(star_checks(sphere(900)), w);
  const double rule = pinv_cut(900, 900);
  const SpectralFactors f = spectral_factors(phi, rule, Workers(1));
  EXPECT_FALSE(f.complete);
  const lapack::Svd full = lapack::svd(phi);
  const auto rank = [&](const Eigen::VectorXd& s) { return (s.array() > rule * s(0)).count(); };
  EXPECT_EQ(rank(f.s), rank(full.s));
}

TEST(Spectral, RectangularMatrices) {
  const Eigen::MatrixXd a = decaying(700, 0.7, false).leftCols(560);
  for (const bool wide : {false, true}) {
    const Eigen::MatrixXd b = wide ? a.transpose() : a;
    const SpectralFactors f = spectral_factors(b, 1e-9, Workers(1));
    EXPECT_LT(f.s.size(), 280);
    EXPECT_LT((b - f.u * f.s.asDiagonal() * f.v.transpose()).cwiseAbs().maxCoeff(), 3e-9);
  }
}

TEST(Spectral, SameBitsForAnyNumberOfThreads) {
  const Eigen::MatrixXd a = decaying(600, 0.8, false);
  const SpectralFactors one = spectral_factors(a, cut, Workers(1));
  const SpectralFactors three = spectral_factors(a, cut, Workers(3));
  EXPECT_EQ(one.s, three.s);
  EXPECT_EQ(one.u, three.u);
  EXPECT_EQ(one.v, three.v);
}

}  // namespace
}  // namespace knotlight
