// The one part that knows LAPACK and BLAS: factorisations and products of dense matrices as plain
// functions.
//
// Every call runs on one BLAS thread: OpenBLAS cuts its loops by the number of its threads, which
// changes the order of sums and so the last bits. What is worth more than one thread is cut into
// pieces of fixed size here. What can go wrong with the numbers is a value (message), never an
// exception; an argument of ours out of range is an assertion. Matrices are column-major.
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/parallel.h"

namespace knotlight::lapack {

// A matrix, or some of its columns, as they are.
using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;

// a^T b or a b, in pieces, one a thread at a time.
Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b, bool transpose_a,
                        const Workers& workers);

// a = u diag(s) vt, s decreasing; l = min(m, n).
struct Svd {
  Eigen::MatrixXd u, vt;  // m x l, l x n
  Eigen::VectorXd s;      // l
  std::string message;    // why there is none; empty if there is
};
// a is consumed. dgesdd, divide and conquer, which beats dgesvd [V09 tab. 7.2].
Svd svd(Eigen::MatrixXd& a);

// a = v diag(d) v^T of a symmetric matrix, d increasing; a becomes v. dsyevd. Returns why it
// failed; empty if it did not.
std::string symmetric_eigen(Eigen::MatrixXd& a, Eigen::VectorXd& d);

// a (m x n, m >= n) = q r. a becomes q; returns r, n x n upper. dgeqrf, dorgqr.
Eigen::MatrixXd thin_qr(Eigen::MatrixXd& a);

// a p = q r with |r_ii| decreasing, dgeqp3; q as LAPACK's reflectors below the diagonal.
struct PivotedQr {
  Eigen::MatrixXd a;
  Eigen::VectorXd tau;
  Eigen::VectorXi columns;  // from 1: column j of a p is column columns(j) of a
};
PivotedQr pivoted_qr(Eigen::MatrixXd a);
Eigen::MatrixXd apply_q_transposed(const PivotedQr& qr, Eigen::MatrixXd b);

// a = p l u of a square matrix, dgetrf.
struct Lu {
  Eigen::MatrixXd a;
  Eigen::VectorXi rows;   // LAPACK's row exchanges
  bool singular = false;  // a pivot is exactly zero
};
Lu lu(Eigen::MatrixXd a);
// x of a x = b or a^T x = b.
Eigen::MatrixXd lu_solve(const Lu& lu, Eigen::MatrixXd b, bool transposed);

}  // namespace knotlight::lapack
