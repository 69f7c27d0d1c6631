#include "bkm/lapack.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/not_finite.h"

extern "C" {
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
            const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
            const double* beta, double* c, const int* ldc);
void dgesdd_(const char* jobz, const int* m, const int* n, double* a, const int* lda, double* s,
             double* u, const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork,
             int* iwork, int* info);
void dsyevd_(const char* jobz, const char* uplo, const int* n, double* a, const int* lda, double* w,
             double* work, const int* lwork, int* iwork, const int* liwork, int* info);
void dgeqrf_(const int* m, const int* n, double* a, const int* lda, double* tau, double* work,
             const int* lwork, int* info);
void dorgqr_(const int* m, const int* n, const int* k, double* a, const int* lda, const double* tau,
             double* work, const int* lwork, int* info);
void dgeqp3_(const int* m, const int* n, double* a, const int* lda, int* jpvt, double* tau,
             double* work, const int* lwork, int* info);
void dormqr_(const char* side, const char* trans, const int* m, const int* n, const int* k,
             const double* a, const int* lda, const double* tau, double* c, const int* ldc,
             double* work, const int* lwork, int* info);
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* ipiv, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda,
             const int* ipiv, double* b, const int* ldb, int* info);
// Only OpenBLAS has these; weak, so that any other LAPACK links as well.
void openblas_set_num_threads(int) __attribute__((weak));
int openblas_get_num_threads() __attribute__((weak));
}

namespace knotlight::lapack {
namespace {

// Rows and columns of one piece of a product: large enough to run at full speed, several a thread.
constexpr Eigen::Index piece_rows = 512, piece_columns = 256;

void one_blas_thread() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);
}

int rows_of(const Eigen::MatrixXd& a) {
  return static_cast<int>(a.rows());
}
int columns_of(const Eigen::MatrixXd& a) {
  return static_cast<int>(a.cols());
}

// Calls a LAPACK routine twice: for the size of its work space, then for its work.
template <typename Routine>
int with_work_space(const Routine& routine) {
  double best_size = nan;
  int lwork = -1;
  int info = 0;
  routine(&best_size, &lwork, &info);
  assert(info == 0);
  lwork = static_cast<int>(best_size);
  Eigen::VectorXd work(lwork);
  routine(work.data(), &lwork, &info);
  assert(info >= 0);  // < 0 would be an argument of ours that is out of range
  return info;
}

}  // namespace

Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b, bool transpose_a,
                        const Workers& workers) {
  one_blas_thread();
  const int inner = static_cast<int>(b.rows());
  const int lda = static_cast<int>(a.outerStride()), ldb = static_cast<int>(b.outerStride());
  assert(inner == (transpose_a ? a.rows() : a.cols()));
  Eigen::MatrixXd c(transpose_a ? a.cols() : a.rows(), b.cols());
  if (inner == 0) c.setZero();
  if (c.size() == 0 || inner == 0) return c;
  const double one = 1.0, zero = 0.0;
  const Eigen::Index down = (c.rows() + piece_rows - 1) / piece_rows;
  const Eigen::Index across = (c.cols() + piece_columns - 1) / piece_columns;
  const int ldc = rows_of(c);
  workers.for_chunks(
      static_cast<std::size_t>(down * across), 1, [&](std::size_t piece, std::size_t, std::size_t) {
        const Eigen::Index i = static_cast<Eigen::Index>(piece) % down * piece_rows;
        const Eigen::Index j = static_cast<Eigen::Index>(piece) / down * piece_columns;
        const int m = static_cast<int>(std::min(piece_rows, c.rows() - i));
        const int n = static_cast<int>(std::min(piece_columns, c.cols() - j));
        dgemm_(transpose_a ? "T" : "N", "N", &m, &n, &inner, &one,
               a.data() + (transpose_a ? i * lda : i), &lda, b.data() + j * ldb, &ldb, &zero,
               c.data() + j * ldc + i, &ldc);
      });
  return c;
}

// Outputs are poisoned first: what LAPACK leaves unwritten is then found by the finite check.
Svd svd(Eigen::MatrixXd& a) {
  one_blas_thread();
  const int m = rows_of(a), n = columns_of(a), least = std::min(m, n);
  Svd result{Eigen::MatrixXd::Constant(m, least, nan),
             Eigen::MatrixXd::Constant(least, n, nan),
             Eigen::VectorXd::Constant(least, nan),
             {}};
  Eigen::VectorXi iwork(8 * least);
  const int failed = with_work_space([&](double* work, const int* lwork, int* info) {
    dgesdd_("S", &m, &n, a.data(), &m, result.s.data(), result.u.data(), &m, result.vt.data(),
            &least, work, lwork, iwork.data(), info);
  });
  if (failed > 0)
    result.message = "the singular value decomposition did not converge (dgesdd)";
  else if (!result.u.allFinite() || !result.s.allFinite() || !result.vt.allFinite())
    result.message = "the singular value decomposition is not finite (dgesdd)";
  return result;
}

std::string symmetric_eigen(Eigen::MatrixXd& a, Eigen::VectorXd& d) {
  one_blas_thread();
  const int n = rows_of(a);
  assert(columns_of(a) == n);
  d = Eigen::VectorXd::Constant(n, nan);
  Eigen::VectorXi iwork(3 + 5 * n);  // what dsyevd's documentation asks for
  const int liwork = static_cast<int>(iwork.size());
  const int failed = with_work_space([&](double* work, const int* lwork, int* info) {
    dsyevd_("V", "L", &n, a.data(), &n, d.data(), work, lwork, iwork.data(), &liwork, info);
  });
  if (failed > 0) return "the eigenvalue decomposition did not converge (dsyevd)";
  if (!a.allFinite() || !d.allFinite())
    return "the eigenvalue decomposition is not finite (dsyevd)";
  return {};
}

Eigen::MatrixXd thin_qr(Eigen::MatrixXd& a) {
  one_blas_thread();
  const int m = rows_of(a), n = columns_of(a);
  assert(m >= n);
  Eigen::VectorXd tau(n);
  with_work_space([&](double* work, const int* lwork, int* info) {
    dgeqrf_(&m, &n, a.data(), &m, tau.data(), work, lwork, info);
  });
  Eigen::MatrixXd r = a.topRows(n).triangularView<Eigen::Upper>();
  with_work_space([&](double* work, const int* lwork, int* info) {
    dorgqr_(&m, &n, &n, a.data(), &m, tau.data(), work, lwork, info);
  });
  return r;
}

PivotedQr pivoted_qr(Eigen::MatrixXd a) {
  one_blas_thread();
  const int m = rows_of(a), n = columns_of(a);
  PivotedQr qr{std::move(a), Eigen::VectorXd::Constant(std::min(m, n), nan),
               Eigen::VectorXi::Zero(n)};
  with_work_space([&](double* work, const int* lwork, int* info) {
    dgeqp3_(&m, &n, qr.a.data(), &m, qr.columns.data(), qr.tau.data(), work, lwork, info);
  });
  return qr;
}

Eigen::MatrixXd apply_q_transposed(const PivotedQr& qr, Eigen::MatrixXd b) {
  one_blas_thread();
  const int m = rows_of(qr.a), n = columns_of(b), reflectors = static_cast<int>(qr.tau.size());
  assert(rows_of(b) == m);
  with_work_space([&](double* work, const int* lwork, int* info) {
    dormqr_("L", "T", &m, &n, &reflectors, qr.a.data(), &m, qr.tau.data(), b.data(), &m, work,
            lwork, info);
  });
  return b;
}

Lu lu(Eigen::MatrixXd a) {
  one_blas_thread();
  const int n = rows_of(a);
  assert(columns_of(a) == n);
  Lu result{std::move(a), Eigen::VectorXi::Zero(n), false};
  int info = 0;
  dgetrf_(&n, &n, result.a.data(), &n, result.rows.data(), &info);
  assert(info >= 0);
  result.singular = info > 0;
  return result;
}

Eigen::MatrixXd lu_solve(const Lu& lu, Eigen::MatrixXd b, bool transposed) {
  one_blas_thread();
  const int n = rows_of(lu.a), columns = columns_of(b);
  assert(rows_of(b) == n && !lu.singular);
  int info = 0;
  dgetrs_(transposed ? "T" : "N", &n, &columns, lu.a.data(), &n, lu.rows.data(), b.data(), &n,
          &info);
  assert(info == 0);
  return b;
}

}  // namespace knotlight::lapack
