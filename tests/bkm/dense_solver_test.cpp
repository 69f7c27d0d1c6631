#include "bkm/dense_solver.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <thread>

#include "core/rng.h"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace knotlight {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index m, Eigen::Index n, std::uint64_t stream) {
  Eigen::MatrixXd a(m, n);
  Rng rng(11, Stream::tests, stream);
  for (double& x : a.reshaped()) x = 2.0 * rng.uniform() - 1.0;
  return a;
}

Eigen::MatrixXd orthonormal(Eigen::Index n, std::uint64_t stream) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(random_matrix(n, n, stream)).householderQ();
}

// The pseudo-inverse itself, column by column.
Eigen::MatrixXd explicit_inverse(const PseudoInverse& p, Eigen::Index m, Eigen::Index n) {
  Eigen::MatrixXd x(n, m);
  for (Eigen::Index j = 0; j < m; ++j) x.col(j) = p.solve(Eigen::VectorXd::Unit(m, j));
  return x;
}

// The four identities that define the Moore-Penrose inverse; rounding of products of some tens of
// terms with a condition of at most 1e3.
constexpr double identity_tolerance = 1e-11;

void expect_moore_penrose(const Eigen::MatrixXd& a, const PseudoInverse& p) {
  const Eigen::MatrixXd x = explicit_inverse(p, a.rows(), a.cols());
  EXPECT_LT((a * x * a - a).cwiseAbs().maxCoeff(), identity_tolerance);
  EXPECT_LT((x * a * x - x).cwiseAbs().maxCoeff(), identity_tolerance);
  EXPECT_LT((a * x - (a * x).transpose()).cwiseAbs().maxCoeff(), identity_tolerance);
  EXPECT_LT((x * a - (x * a).transpose()).cwiseAbs().maxCoeff(), identity_tolerance);
}

TEST(DenseSolver, MoorePenroseFullRank) {
  for (const auto& [m, n] : {std::pair{1, 1}, {30, 30}, {40, 17}, {17, 40}}) {
    const Eigen::MatrixXd a = random_matrix(m, n, 1);
    const PseudoInverse p(a, -1.0);
    ASSERT_TRUE(p.ok()) << p.message();
    EXPECT_EQ(p.rank(), std::min(m, n));
    expect_moore_penrose(a, p);
  }
}

TEST(DenseSolver, MoorePenroseRankDeficient) {
  for (const auto& [m, n] : {std::pair{30, 30}, {40, 17}, {17, 40}}) {
    const Eigen::MatrixXd a = random_matrix(m, 5, 2) * random_matrix(5, n, 3);
    const PseudoInverse p(a, -1.0);
    ASSERT_TRUE(p.ok());
    EXPECT_EQ(p.rank(), 5);
    expect_moore_penrose(a, p);
  }
}

TEST(DenseSolver, LeastNormSolution) {
  const Eigen::MatrixXd a = random_matrix(6, 10, 4);
  const Eigen::VectorXd b = a * random_matrix(10, 1, 5);
  const Eigen::VectorXd x = PseudoInverse(a, -1.0).solve(b);
  EXPECT_LT((a * x - b).norm(), identity_tolerance);
  // Of least norm: orthogonal to the null space, that is a combination of the rows.
  const Eigen::VectorXd y = a.transpose().colPivHouseholderQr().solve(x);
  EXPECT_LT((a.transpose() * y - x).norm(), identity_tolerance);
}

TEST(DenseSolver, SingularValuesAndCut) {
  constexpr Eigen::Index n = 12;
  Eigen::VectorXd s(n);
  for (Eigen::Index i = 0; i < n; ++i) s(i) = 5.0 * std::pow(10.0, -static_cast<double>(i));
  const Eigen::MatrixXd a = orthonormal(n, 6) * s.asDiagonal() * orthonormal(n, 7).transpose();
  const PseudoInverse p(a, 3e-7);
  EXPECT_EQ(p.rank(), 7);  // 1, 1e-1, ..., 1e-6 of the largest
  for (Eigen::Index i = 0; i < n; ++i) EXPECT_NEAR(p.singular_values()(i), s(i), 1e-14);
  EXPECT_NEAR(p.condition() / 1e11, 1.0, 1e-3);  // the smallest is known to 1e-15 / 5e-11
}

// MATLAB's rule is max(m, n) eps: values of 1.5 and 0.5 times that are kept and dropped.
TEST(DenseSolver, DefaultCutIsMatlabs) {
  constexpr Eigen::Index m = 20, n = 8;
  const double rule = m * std::numeric_limits<double>::epsilon();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m, n);
  for (Eigen::Index i = 0; i < n; ++i) a(i, i) = 1.0;
  a(6, 6) = 1.5 * rule;
  a(7, 7) = 0.5 * rule;
  EXPECT_EQ(PseudoInverse(a, -1.0).rank(), 7);
  EXPECT_EQ(PseudoInverse(a, 0.0).rank(), 8);
}

TEST(DenseSolver, ZeroMatrixGivesZero) {
  const PseudoInverse p(Eigen::MatrixXd::Zero(4, 3), -1.0);
  EXPECT_TRUE(p.ok());
  EXPECT_EQ(p.rank(), 0);
  EXPECT_EQ(p.solve(Eigen::VectorXd::Ones(4)), Eigen::VectorXd::Zero(3));
  EXPECT_TRUE(std::isinf(p.condition()) || std::isnan(p.condition()));
}

TEST(DenseSolver, NotFiniteIsAValueNotACrash) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd a = random_matrix(5, 4, 8);
    a(2, 1) = bad;
    const PseudoInverse p(a, -1.0);
    EXPECT_FALSE(p.ok());
    EXPECT_NE(p.message().find("not finite"), std::string::npos) << p.message();
    EXPECT_EQ(p.rank(), 0);
    EXPECT_TRUE(std::isnan(p.condition()));
    const Eigen::VectorXd x = p.solve(Eigen::VectorXd::Ones(5));
    ASSERT_EQ(x.size(), 4);
    EXPECT_TRUE(x.array().isNaN().all());
  }
  const PseudoInverse good(random_matrix(5, 4, 8), -1.0);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(5);
  b(3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(good.solve(b).array().isNaN().all());
}

// Large enough for OpenBLAS to split its loops. Other LAPACKs have no threads to set.
TEST(DenseSolver, SameBitsWhateverTheBlasThreads) {
  if (openblas_set_num_threads == nullptr) GTEST_SKIP() << "not linked with OpenBLAS";
  const Eigen::MatrixXd a = random_matrix(300, 300, 9);
  const Eigen::VectorXd b = random_matrix(300, 1, 10);
  openblas_set_num_threads(1);
  const Eigen::VectorXd one = PseudoInverse(a, -1.0).solve(b);
  openblas_set_num_threads(2);
  EXPECT_EQ(PseudoInverse(a, -1.0).solve(b), one);
}

TEST(DenseSolver, TwoThreadsAtOnce) {
  const Eigen::MatrixXd a = random_matrix(150, 150, 12);
  const Eigen::VectorXd b = random_matrix(150, 1, 13);
  const Eigen::VectorXd alone = PseudoInverse(a, -1.0).solve(b);
  Eigen::VectorXd x[2];
  std::thread other([&] { x[0] = PseudoInverse(a, -1.0).solve(b); });
  x[1] = PseudoInverse(a, -1.0).solve(b);
  other.join();
  EXPECT_EQ(x[0], alone);
  EXPECT_EQ(x[1], alone);
}

}  // namespace
}  // namespace knotlight
