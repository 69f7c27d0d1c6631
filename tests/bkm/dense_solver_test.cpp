#include "bkm/dense_solver.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

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
Eigen::MatrixXd explicit_inverse(const DenseSolver& p, Eigen::Index m, Eigen::Index n) {
  Eigen::MatrixXd x(n, m);
  for (Eigen::Index j = 0; j < m; ++j) x.col(j) = p.solve(Eigen::VectorXd::Unit(m, j));
  return x;
}

// The four identities that define the Moore-Penrose inverse; rounding of products of some tens of
// terms with a condition of at most 1e3.
constexpr double identity_tolerance = 1e-11;

void expect_moore_penrose(const Eigen::MatrixXd& a, const DenseSolver& p) {
  const Eigen::MatrixXd x = explicit_inverse(p, a.rows(), a.cols());
  EXPECT_LT((a * x * a - a).cwiseAbs().maxCoeff(), identity_tolerance);
  EXPECT_LT((x * a * x - x).cwiseAbs().maxCoeff(), identity_tolerance);
  EXPECT_LT((a * x - (a * x).transpose()).cwiseAbs().maxCoeff(), identity_tolerance);
  EXPECT_LT((x * a - (x * a).transpose()).cwiseAbs().maxCoeff(), identity_tolerance);
}

TEST(DenseSolver, MoorePenroseFullRank) {
  for (const auto& [m, n] : {std::pair{1, 1}, {30, 30}, {40, 17}, {17, 40}}) {
    const Eigen::MatrixXd a = random_matrix(m, n, 1);
    const DenseSolver p(a);
    ASSERT_TRUE(p.ok()) << p.message();
    EXPECT_EQ(p.rank(), std::min(m, n));
    expect_moore_penrose(a, p);
  }
}

TEST(DenseSolver, MoorePenroseRankDeficient) {
  for (const auto& [m, n] : {std::pair{30, 30}, {40, 17}, {17, 40}}) {
    const Eigen::MatrixXd a = random_matrix(m, 5, 2) * random_matrix(5, n, 3);
    const DenseSolver p(a);
    ASSERT_TRUE(p.ok());
    EXPECT_EQ(p.rank(), 5);
    expect_moore_penrose(a, p);
  }
}

TEST(DenseSolver, LeastNormSolution) {
  const Eigen::MatrixXd a = random_matrix(6, 10, 4);
  const Eigen::VectorXd b = a * random_matrix(10, 1, 5);
  const Eigen::VectorXd x = DenseSolver(a).solve(b);
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
  const DenseSolver p(a, {DenseMethod::svd, 3e-7});
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
  EXPECT_EQ(DenseSolver(a).rank(), 7);
  EXPECT_EQ(DenseSolver(a, {DenseMethod::svd, 0.0}).rank(), 8);
}

TEST(DenseSolver, ZeroMatrixGivesZero) {
  const DenseSolver p(Eigen::MatrixXd::Zero(4, 3));
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
    const DenseSolver p(a);
    EXPECT_FALSE(p.ok());
    EXPECT_NE(p.message().find("not finite"), std::string::npos) << p.message();
    EXPECT_EQ(p.rank(), 0);
    EXPECT_TRUE(std::isnan(p.condition()));
    const Eigen::VectorXd x = p.solve(Eigen::VectorXd::Ones(5));
    ASSERT_EQ(x.size(), 4);
    EXPECT_TRUE(x.array().isNaN().all());
  }
  const DenseSolver good(random_matrix(5, 4, 8));
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
  const Eigen::VectorXd one = DenseSolver(a).solve(b);
  openblas_set_num_threads(2);
  EXPECT_EQ(DenseSolver(a).solve(b), one);
}

TEST(DenseSolver, TwoThreadsAtOnce) {
  const Eigen::MatrixXd a = random_matrix(150, 150, 12);
  const Eigen::VectorXd b = random_matrix(150, 1, 13);
  const Eigen::VectorXd alone = DenseSolver(a).solve(b);
  Eigen::VectorXd x[2];
  std::thread other([&] { x[0] = DenseSolver(a).solve(b); });
  x[1] = DenseSolver(a).solve(b);
  other.join();
  EXPECT_EQ(x[0], alone);
  EXPECT_EQ(x[1], alone);
}

constexpr DenseMethod all_methods[] = {DenseMethod::svd, DenseMethod::qr, DenseMethod::lu,
                                       DenseMethod::tikhonov_gcv, DenseMethod::tikhonov_l_curve};

// Eigenvalues 1, 1/2, 1/4 ...: no method needs to cut or damp anything.
TEST(DenseSolver, AllMethodsAgreeOnAGoodMatrix) {
  constexpr Eigen::Index n = 12;
  Eigen::VectorXd s(n);
  for (Eigen::Index i = 0; i < n; ++i) s(i) = std::exp2(-static_cast<double>(i));
  const Eigen::MatrixXd q = orthonormal(n, 20);
  const Eigen::MatrixXd a = q * s.asDiagonal() * orthonormal(n, 21).transpose();
  const Eigen::VectorXd x = random_matrix(n, 1, 22), b = a * x;
  for (const DenseMethod method : all_methods) {
    const DenseSolver solver(a, {method});
    ASSERT_TRUE(solver.ok());
    const DenseSolution found = solver.solve_with_figures(b);
    // Noise-free data let GCV go down to the smallest value; the corner of the L-curve need not.
    if (method == DenseMethod::tikhonov_gcv || method == DenseMethod::tikhonov_l_curve) {
      EXPECT_GT(found.regulariser, 0.0);
      EXPECT_LE(found.regulariser, 1.0);
    } else {
      EXPECT_LT((found.x - x).norm(), 1e-11);
      EXPECT_LT((solver.solve_columns(b) - found.x).norm(), 1e-11);
      EXPECT_EQ(found.regulariser, 0.0);
    }
    EXPECT_EQ(solver.rank(), n);
    // By power iteration: from below for the largest value, from above for the smallest.
    EXPECT_NEAR(solver.condition() / 2048.0, 1.0, 0.03) << static_cast<int>(method);
  }
}

// |b| / (sigma_min |x|): the condition for the worst b, 1 for the best.
TEST(DenseSolver, EffectiveConditionDependsOnTheData) {
  constexpr Eigen::Index n = 8;
  Eigen::VectorXd s(n);
  for (Eigen::Index i = 0; i < n; ++i) s(i) = std::pow(10.0, -static_cast<double>(i));
  const Eigen::MatrixXd u = orthonormal(n, 23);
  const Eigen::MatrixXd a = u * s.asDiagonal() * orthonormal(n, 24).transpose();
  for (const DenseMethod method : {DenseMethod::svd, DenseMethod::qr, DenseMethod::lu}) {
    const DenseSolver solver(a, {method});
    for (const Eigen::Index i : {0, 3, 7}) {
      const double expected = s(i) / s(n - 1);
      EXPECT_NEAR(solver.solve_with_figures(u.col(i)).effective_condition / expected, 1.0, 0.05);
    }
    EXPECT_EQ(solver.solve_with_figures(Eigen::VectorXd::Zero(n)).effective_condition, 1.0);
  }
  // Values that are cut are not used.
  const DenseSolver cut(a, {DenseMethod::svd, 3e-4});
  EXPECT_NEAR(cut.solve_with_figures(u.col(0)).effective_condition / 1e3, 1.0, 1e-6);
}

TEST(DenseSolver, SingularMatrices) {
  const Eigen::MatrixXd a = random_matrix(20, 5, 25) * random_matrix(5, 20, 26);
  const DenseSolver qr(a, {DenseMethod::qr});
  EXPECT_EQ(qr.rank(), 5);
  const Eigen::VectorXd b = a * random_matrix(20, 1, 27);
  EXPECT_LT((a * qr.solve(b) - b).norm(), identity_tolerance);
  EXPECT_TRUE(std::isinf(DenseSolver(Eigen::MatrixXd::Zero(3, 3), {DenseMethod::qr}).condition()));

  const DenseSolver lu(Eigen::MatrixXd::Ones(6, 6), {DenseMethod::lu});
  EXPECT_FALSE(lu.ok());
  EXPECT_NE(lu.message().find("singular"), std::string::npos);
  EXPECT_TRUE(lu.solve(Eigen::VectorXd::Ones(6)).array().isNaN().all());
}

TEST(DenseSolver, NotFiniteDataWithEveryMethod) {
  const Eigen::MatrixXd a = random_matrix(10, 10, 28);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(10);
  b(4) = std::numeric_limits<double>::quiet_NaN();
  for (const DenseMethod method : all_methods) {
    EXPECT_TRUE(DenseSolver(a, {method}).solve(b).array().isNaN().all());
    EXPECT_TRUE(DenseSolver(a, {method}).solve_columns(b).array().isNaN().all());
  }
}

// The oracle: take a row and its column out, solve the rest, predict what was taken out.
TEST(DenseSolver, LeaveOneOutAgreesWithLeavingOneOut) {
  constexpr Eigen::Index n = 15;
  const Eigen::MatrixXd half = random_matrix(n, n, 29);
  const Eigen::MatrixXd a =
      half + half.transpose() + 6.0 * Eigen::MatrixXd::Identity(n, n);  // well conditioned
  const Eigen::VectorXd b = random_matrix(n, 1, 30);
  Eigen::VectorXd expected(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index j = 0; j < n; ++j)
      if (j != i) others.push_back(j);
    const Eigen::MatrixXd rest = a(others, others);
    const Eigen::VectorXd x = rest.colPivHouseholderQr().solve(Eigen::VectorXd(b(others)));
    expected(i) = b(i) - a.row(i)(others).dot(x);
  }
  for (const DenseMethod method : {DenseMethod::svd, DenseMethod::qr, DenseMethod::lu})
    EXPECT_LT((DenseSolver(a, {method}).leave_one_out(b) - expected).norm(), identity_tolerance)
        << static_cast<int>(method);
}

}  // namespace
}  // namespace knotlight
