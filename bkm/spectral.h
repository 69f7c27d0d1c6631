// Singular value decomposition of a matrix that has few singular values worth keeping, at a price
// that follows their number.
//
// The matrices of smooth kernels have a numerical rank r far below their size n: a full
// decomposition, some 10 n^3 operations, half of them bound by memory, computes n - r triplets that
// are then thrown away. Instead the matrix is multiplied with random columns, 64 at a time, until
// what 64 new products add to the range of the others lies well below the cut, which is the proof
// that nothing is missing [HMT11 alg. 4.2, 5.1]: k columns, a little more than r, 4 n^2 k
// operations, nearly all of them matrix products. What is left to decompose is k wide. Where the
// rank is not small (seen early by how slowly the products shrink) a full decomposition follows. Of
// a symmetric matrix both are done by eigenvalues, which are the singular values but for their
// signs and cost less than half.
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/parallel.h"

namespace knotlight {

// a = u diag(s) v^T but for what lies below the cut.
struct SpectralFactors {
  Eigen::MatrixXd u, v;  // m x l, n x l: one column for every singular value found
  Eigen::VectorXd s;     // l, decreasing; all min(m, n) of them if `complete`
  bool complete = false;
  std::string message;  // why there are none; empty if there are
};

// a: m x n, finite, consumed. Singular values above relative_cut times the largest are found, and
// some below. The same bits for any number of workers.
SpectralFactors spectral_factors(Eigen::MatrixXd a, double relative_cut, const Workers& workers);

// MATLAB's pinv rule [V09 ch. 6.3]: values up to max(m, n) 2^-52 of the largest are rounding.
double pinv_cut(Eigen::Index rows, Eigen::Index columns);

}  // namespace knotlight
