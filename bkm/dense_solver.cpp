#include "bkm/dense_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

extern "C" {
// LAPACK 3, driver dgesdd: a = u diag(s) vt by divide and conquer; column-major.
void dgesdd_(const char* jobz, const int* m, const int* n, double* a, const int* lda, double* s,
             double* u, const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork,
             int* iwork, int* info);
// Only OpenBLAS has these; weak, so that any other LAPACK links as well.
void openblas_set_num_threads(int) __attribute__((weak));
int openblas_get_num_threads() __attribute__((weak));
}

namespace knotlight {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// OpenBLAS cuts its loops by the number of threads, which changes the order of sums and so the last
// bits. Our parallelism is over colour channels instead.
void one_blas_thread() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);
}

struct Svd {
  Eigen::MatrixXd u, vt;  // m x min(m, n), min(m, n) x n
  Eigen::VectorXd s;      // min(m, n)
  int info = 0;
};

// Outputs are poisoned first: what LAPACK leaves unwritten is then found by the finite check.
Svd decompose(Eigen::MatrixXd& a) {
  const int m = static_cast<int>(a.rows());
  const int n = static_cast<int>(a.cols());
  const int least = std::min(m, n);
  Svd svd{Eigen::MatrixXd::Constant(m, least, nan), Eigen::MatrixXd::Constant(least, n, nan),
          Eigen::VectorXd::Constant(least, nan), 0};
  Eigen::VectorXi iwork(8 * least);
  double best_size = nan;
  const int ask = -1;
  dgesdd_("S", &m, &n, a.data(), &m, svd.s.data(), svd.u.data(), &m, svd.vt.data(), &least,
          &best_size, &ask, iwork.data(), &svd.info);
  assert(svd.info == 0);
  const int lwork = static_cast<int>(best_size);
  Eigen::VectorXd work(lwork);
  dgesdd_("S", &m, &n, a.data(), &m, svd.s.data(), svd.u.data(), &m, svd.vt.data(), &least,
          work.data(), &lwork, iwork.data(), &svd.info);
  // info < 0 would be an argument of ours that is out of range.
  assert(svd.info >= 0);
  return svd;
}

}  // namespace

PseudoInverse::PseudoInverse(Eigen::MatrixXd a, double relative_cut)
    : rows_(a.rows()), columns_(a.cols()) {
  assert(a.size() > 0);
  message_ = factor(a, relative_cut);
  if (!ok()) s_ = Eigen::VectorXd::Constant(std::min(rows_, columns_), nan);
}

std::string PseudoInverse::factor(Eigen::MatrixXd& a, double relative_cut) {
  if (!a.allFinite()) return "the matrix has an entry that is not finite";
  one_blas_thread();
  Svd svd = decompose(a);
  if (svd.info > 0) return "the singular value decomposition did not converge (dgesdd)";
  if (!svd.u.allFinite() || !svd.s.allFinite() || !svd.vt.allFinite())
    return "the singular value decomposition is not finite (dgesdd)";

  s_ = std::move(svd.s);
  const double size = static_cast<double>(std::max(rows_, columns_));
  const double cut =
      relative_cut < 0.0 ? size * std::numeric_limits<double>::epsilon() : relative_cut;
  rank_ = static_cast<int>((s_.array() > cut * s_(0)).count());
  u_ = svd.u.leftCols(rank_);
  v_ = svd.vt.topRows(rank_).transpose();
  return {};
}

Eigen::VectorXd PseudoInverse::solve(const Eigen::VectorXd& b) const {
  assert(b.size() == rows_);
  if (!ok()) return Eigen::VectorXd::Constant(columns_, nan);
  const Eigen::VectorXd scaled = (u_.transpose() * b).cwiseQuotient(s_.head(rank_));
  return v_ * scaled;
}

double PseudoInverse::condition() const {
  if (!ok()) return nan;
  const double least = s_(s_.size() - 1);
  return least > 0.0 ? s_(0) / least : std::numeric_limits<double>::infinity();
}

}  // namespace knotlight
