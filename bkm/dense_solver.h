// The one file that knows LAPACK: singular value decompositions kept for many right-hand sides.
#pragma once

#include <Eigen/Core>
#include <string>

namespace knotlight {

// Truncated pseudo-inverse V S^+ U^T of a dense matrix [V09 6.25-6.27]. Singular values at or below
// cut * max(S) are dropped. What can go wrong with the numbers is a value (ok, message), never an
// exception; objects may be made and used in several threads at once.
class PseudoInverse {
 public:
  // a: m x n, m, n >= 1, consumed (LAPACK overwrites it). relative_cut < 0: MATLAB's pinv rule,
  // max(m, n) * 2^-52. Computed by dgesdd, which beats dgesvd [V09 tab. 7.2]; single-threaded, so
  // that bits do not depend on threads.
  PseudoInverse(Eigen::MatrixXd a, double relative_cut);

  // x (n) of least norm among the least-squares solutions of a x = b (m); all NaN if not ok().
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  bool ok() const {
    return message_.empty();
  }  // false: the SVD did not converge or a was not finite
  const std::string& message() const { return message_; }  // why not ok; empty if ok
  int rank() const { return rank_; }                       // singular values kept; 0 if not ok
  double condition() const;  // max(S) / min(S), all values; infinite if singular, NaN if not ok
  const Eigen::VectorXd& singular_values() const {
    return s_;
  }  // decreasing, min(m, n); NaN if not

 private:
  // Returns why it failed; empty if it did not.
  std::string factor(Eigen::MatrixXd& a, double relative_cut);

  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXd u_, v_;  // m x rank, n x rank: what is left after the cut
  Eigen::VectorXd s_;
  int rank_ = 0;
  std::string message_;
};

}  // namespace knotlight
