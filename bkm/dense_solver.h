// Dense systems that are nearly singular, factored once for many right-hand sides, by the method of
// the caller's choice.
#pragma once

#include <Eigen/Core>
#include <string>

#include "bkm/lapack.h"
#include "bkm/spectral.h"
#include "bkm/tikhonov.h"
#include "core/bkm_choices.h"
#include "core/parallel.h"

namespace knotlight {

struct DenseSolverOptions {
  DenseMethod method = DenseMethod::svd;
  // Of the largest singular value (svd) or diagonal entry of R (qr): what is not above it counts as
  // zero. < 0: MATLAB's pinv rule, max(m, n) * 2^-52. The Tikhonov methods damp instead of cutting
  // and look no further down than to 2^-52; lu takes everything.
  double relative_cut = -1.0;
  Workers workers = Workers(1);  // the same bits for any number
};

// A solution and how it came about.
struct DenseSolution {
  Eigen::VectorXd x;         // n
  double regulariser = 0.0;  // mu of the Tikhonov methods, in units of the matrix; else 0
  // |b| / (sigma |x|), 1/sigma being the largest factor by which the method multiplies a part of b:
  // how much a relative error of this b can grow, where condition() speaks for the worst b
  // [CF88]. 1 if b = 0.
  double effective_condition = 0.0;
};

// What can go wrong with the numbers is a value (ok, message), never an exception; objects may be
// made and used in several threads at once.
//
//   svd      truncated pseudo-inverse V S^+ U^T [V09 6.25-6.27]: least norm, least squares
//   qr       column pivoting, least squares; coefficients of columns below the cut are 0
//   lu       partial pivoting [V09 fig. 6.3 a]; square matrices
//   tikhonov_gcv, tikhonov_l_curve   one SVD, mu chosen anew for every b: see tikhonov.h
class DenseSolver {
 public:
  // a: m x n, m, n >= 1, consumed.
  explicit DenseSolver(Eigen::MatrixXd a, const DenseSolverOptions& options = {});

  // All NaN if not ok().
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return solve_with_figures(b).x; }
  DenseSolution solve_with_figures(const Eigen::VectorXd& b) const;
  // Column by column.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& b) const;
  // b_i minus what the others say it should be, for each i, n values; a square and symmetric in its
  // knots. Where nothing is cut or damped x_i / (A^-1)_ii, exact [R99]; else (b - H b)_i / (1 -
  // H_ii), H being what the method makes of data: exact but for what knot i adds to the basis.
  Eigen::VectorXd leave_one_out(const Eigen::VectorXd& b) const;

  bool ok() const { return message_.empty(); }             // false: no factors, or a was not finite
  const std::string& message() const { return message_; }  // why not ok; empty if ok
  // Singular values or columns not counted as zero; min(m, n) with lu and Tikhonov; 0 if not ok.
  int rank() const { return rank_; }
  // max(S) / min(S) over the values found, which include some below the cut; by power iteration
  // with lu and qr, good to some per cent. Infinite if singular, NaN if not ok.
  double condition() const { return condition_; }
  // Decreasing; those found (see spectral.h), none with lu and qr.
  const Eigen::VectorXd& singular_values() const { return spectral_.s; }

 private:
  // Each returns why it failed; empty if it did not.
  std::string factor(Eigen::MatrixXd a);
  std::string factor_spectral(Eigen::MatrixXd a);
  std::string factor_lu(Eigen::MatrixXd a);
  void factor_qr(Eigen::MatrixXd a);

  bool spectral() const;  // svd and the Tikhonov methods
  bool damps() const;     // the Tikhonov methods
  DataSpectrum spectrum_of(const Eigen::VectorXd& b) const;
  double regulariser(const Eigen::VectorXd& b) const;
  Eigen::VectorXd weights(double mu) const;  // of u_i . b in the coefficient of v_i
  Eigen::MatrixXd solve_directly(const Eigen::MatrixXd& b) const;  // lu and qr

  DenseSolverOptions options_;
  Eigen::Index rows_ = 0, columns_ = 0;
  SpectralFactors spectral_;  // cut to rank_ columns with svd
  lapack::Lu lu_;
  lapack::PivotedQr qr_;
  int rank_ = 0;
  double condition_ = 0.0;
  double largest_gain_ = 0.0;  // 1/sigma of the smallest part used; not with Tikhonov
  std::string message_;
};

}  // namespace knotlight
