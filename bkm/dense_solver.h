// The one file that knows LAPACK: singular value decompositions kept for many right-hand sides.
#pragma once

#include <Eigen/Core>
#include <string>

namespace knotlight {

// Truncated pseudo-inverse V S^+ U^T of a dense matrix [V09 6.25-6.27]. Singular values at or below
// cut * max(S) are dropped.
class PseudoInverse {
 public:
  // a: m x n, consumed (LAPACK overwrites it). relative_cut < 0: MATLAB's pinv rule,
  // max(m, n) * 2^-52. Computed by dgesdd, single-threaded so that bits do not depend on threads.
  PseudoInverse(Eigen::MatrixXd a, double relative_cut);

  // x (n) of least norm among the least-squares solutions of a x = b (m).
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  bool ok() const { return ok_; }  // false: the SVD did not converge or a was not finite
  const std::string& message() const { return message_; }
  int rank() const { return rank_; }                             // singular values kept
  double condition() const;                                      // max(S) / min(S), all values
  const Eigen::VectorXd& singular_values() const { return s_; }  // decreasing

 private:
  Eigen::MatrixXd u_, vt_;
  Eigen::VectorXd s_;
  int rank_ = 0;
  bool ok_ = false;
  std::string message_;
};

}  // namespace knotlight
