#include "study/svd_routines.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bkm/spectral.h"
#include "core/clock.h"
#include "core/not_finite.h"

extern "C" {
void sgesvd_(const char* jobu, const char* jobvt, const int* m, const int* n, float* a,
             const int* lda, float* s, float* u, const int* ldu, float* vt, const int* ldvt,
             float* work, const int* lwork, int* info);
void dgesvd_(const char* jobu, const char* jobvt, const int* m, const int* n, double* a,
             const int* lda, double* s, double* u, const int* ldu, double* vt, const int* ldvt,
             double* work, const int* lwork, int* info);
void sgesdd_(const char* jobz, const int* m, const int* n, float* a, const int* lda, float* s,
             float* u, const int* ldu, float* vt, const int* ldvt, float* work, const int* lwork,
             int* iwork, int* info);
void dgesdd_(const char* jobz, const int* m, const int* n, double* a, const int* lda, double* s,
             double* u, const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork,
             int* iwork, int* info);
void dgejsv_(const char* joba, const char* jobu, const char* jobv, const char* jobr,
             const char* jobt, const char* jobp, const int* m, const int* n, double* a,
             const int* lda, double* sva, double* u, const int* ldu, double* v, const int* ldv,
             double* work, const int* lwork, int* iwork, int* info);
// Only OpenBLAS has it; weak, so that any other LAPACK links as well.
void openblas_set_num_threads(int) __attribute__((weak));
}

namespace knotlight {
namespace {

template <typename Real>
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// Outputs are poisoned: what LAPACK leaves unwritten makes the residual not-a-number.
template <typename Real>
struct Factors {
  Matrix<Real> u, vt;
  Vector<Real> s;

  explicit Factors(Eigen::Index n)
      : u(Matrix<Real>::Constant(n, n, static_cast<Real>(nan))), vt(u), s(u.col(0)) {}
};

void check(int info, SvdRoutine routine) {
  if (info != 0)
    throw std::runtime_error(fmt::format("{} did not converge ({})", name_of(routine), info));
}

// Calls a routine twice: for the size of its work space, then for its work.
template <typename Real, typename Call>
void with_work_space(SvdRoutine routine, const Call& call) {
  Real best_size = static_cast<Real>(nan);
  int lwork = -1, info = 0;
  call(&best_size, &lwork, &info);
  check(info, routine);
  lwork = static_cast<int>(best_size);
  Vector<Real> work(lwork);
  call(work.data(), &lwork, &info);
  check(info, routine);
}

template <typename Real, typename Routine>
Factors<Real> by_gesvd(SvdRoutine name, const Routine& gesvd, Matrix<Real>& a) {
  const int n = static_cast<int>(a.rows());
  Factors<Real> f(n);
  with_work_space<Real>(name, [&](Real* work, const int* lwork, int* info) {
    gesvd("S", "S", &n, &n, a.data(), &n, f.s.data(), f.u.data(), &n, f.vt.data(), &n, work, lwork,
          info);
  });
  return f;
}

template <typename Real, typename Routine>
Factors<Real> by_gesdd(SvdRoutine name, const Routine& gesdd, Matrix<Real>& a) {
  const int n = static_cast<int>(a.rows());
  Factors<Real> f(n);
  Eigen::VectorXi iwork(8 * n);
  with_work_space<Real>(name, [&](Real* work, const int* lwork, int* info) {
    gesdd("S", &n, &n, a.data(), &n, f.s.data(), f.u.data(), &n, f.vt.data(), &n, work, lwork,
          iwork.data(), info);
  });
  return f;
}

// Rows are pivoted ("F": the matrix may be graded), all singular values asked for.
Factors<double> by_jacobi(Eigen::MatrixXd& a) {
  const int n = static_cast<int>(a.rows());
  Factors<double> f(n);
  // What dgejsv's documentation asks for with both sets of vectors.
  const int lwork = std::max({2 * n + n, 6 * n + 2 * n * n, 7});
  Eigen::VectorXd work(lwork);
  Eigen::VectorXi iwork(4 * n + 3);
  int info = 0;
  dgejsv_("F", "U", "V", "N", "N", "N", &n, &n, a.data(), &n, f.s.data(), f.u.data(), &n,
          f.vt.data(), &n, work.data(), &lwork, iwork.data(), &info);
  check(info, SvdRoutine::dgejsv);
  f.s *= work[0] / work[1];
  f.vt.transposeInPlace();
  return f;
}

template <typename Real>
SvdRun judged(const Factors<Real>& f, const Eigen::MatrixXd& a, double seconds) {
  SvdRun run;
  run.seconds = seconds;
  const Eigen::MatrixXd u = f.u.template cast<double>(), vt = f.vt.template cast<double>();
  const Eigen::VectorXd s = f.s.template cast<double>();
  run.residual = (a - u * s.asDiagonal() * vt).norm() / a.norm();
  const double cut = static_cast<double>(a.rows()) *
                     static_cast<double>(std::numeric_limits<Real>::epsilon()) * s.maxCoeff();
  run.kept = static_cast<int>((s.array() > cut).count());
  return run;
}

template <typename Real, typename Work>
SvdRun timed(const Eigen::MatrixXd& a, const Work& work) {
  Matrix<Real> copy = a.cast<Real>();
  const double start = cpu_seconds();
  const Factors<Real> factors = work(copy);
  return judged(factors, a, cpu_seconds() - start);
}

SvdRun by_sampling(const Eigen::MatrixXd& a) {
  const double cut = pinv_cut(a.rows(), a.cols());
  const double start = cpu_seconds();
  const SpectralFactors f = spectral_factors(a, cut, Workers(1));
  SvdRun run;
  run.seconds = cpu_seconds() - start;
  if (!f.message.empty()) throw std::runtime_error(f.message);
  run.residual = (a - f.u * f.s.asDiagonal() * f.v.transpose()).norm() / a.norm();
  run.kept = static_cast<int>((f.s.array() > cut * f.s[0]).count());
  return run;
}

}  // namespace

const std::vector<SvdRoutine>& svd_routines() {
  using enum SvdRoutine;
  static const std::vector<SvdRoutine> all{sgesvd, sgesdd, dgesvd, dgesdd, dgejsv, sampled};
  return all;
}

std::string name_of(SvdRoutine routine) {
  switch (routine) {
    case SvdRoutine::sgesvd:
      return "sgesvd";
    case SvdRoutine::dgesvd:
      return "dgesvd";
    case SvdRoutine::sgesdd:
      return "sgesdd";
    case SvdRoutine::dgesdd:
      return "dgesdd";
    case SvdRoutine::dgejsv:
      return "dgejsv";
    case SvdRoutine::sampled:
      return "sampled";
  }
  return "";
}

SvdRun run_svd(SvdRoutine routine, const Eigen::MatrixXd& a) {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  switch (routine) {
    case SvdRoutine::sgesvd:
      return timed<float>(a,
                          [&](Eigen::MatrixXf& m) { return by_gesvd<float>(routine, sgesvd_, m); });
    case SvdRoutine::dgesvd:
      return timed<double>(
          a, [&](Eigen::MatrixXd& m) { return by_gesvd<double>(routine, dgesvd_, m); });
    case SvdRoutine::sgesdd:
      return timed<float>(a,
                          [&](Eigen::MatrixXf& m) { return by_gesdd<float>(routine, sgesdd_, m); });
    case SvdRoutine::dgesdd:
      return timed<double>(
          a, [&](Eigen::MatrixXd& m) { return by_gesdd<double>(routine, dgesdd_, m); });
    case SvdRoutine::dgejsv:
      return timed<double>(a, by_jacobi);
    case SvdRoutine::sampled:
      break;
  }
  return by_sampling(a);
}

}  // namespace knotlight
