#include "bkm/dense_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/not_finite.h"

namespace knotlight {
namespace {

// Steps of power iteration for the largest singular value: its error falls as the fourth power of
// the ratio of the first two values with every step, and some per cent are enough.
constexpr int power_steps = 12;

// Largest singular value of the map `apply`, whose transpose is `apply_transposed`.
template <typename Map, typename Transposed>
double largest_singular_value(Eigen::Index columns, const Map& apply,
                              const Transposed& apply_transposed) {
  Eigen::VectorXd x(columns);
  for (Eigen::Index i = 0; i < columns; ++i)  // fixed, and hardly orthogonal to what is looked for
    x(i) = 1.0 + std::sin(static_cast<double>(i));
  double value = 0.0;
  for (int step = 0; step < power_steps; ++step) {
    const Eigen::VectorXd y = apply(x.normalized());
    value = y.norm();
    if (!(value > 0.0) || !std::isfinite(value)) return value;
    x = apply_transposed(y);
  }
  return value;
}

double norm_of(const Eigen::MatrixXd& a) {
  return largest_singular_value(
      a.cols(), [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return a * x; },
      [&](const Eigen::VectorXd& y) -> Eigen::VectorXd { return a.transpose() * y; });
}

}  // namespace

DenseSolver::DenseSolver(Eigen::MatrixXd a, const DenseSolverOptions& options)
    : options_(options), rows_(a.rows()), columns_(a.cols()) {
  assert(a.size() > 0);
  if (options_.relative_cut < 0.0) options_.relative_cut = pinv_cut(rows_, columns_);
  message_ = a.allFinite() ? factor(std::move(a)) : "the matrix has an entry that is not finite";
  if (ok()) return;
  rank_ = 0;
  condition_ = nan;
  spectral_.s = Eigen::VectorXd::Constant(std::min(rows_, columns_), nan);
}

bool DenseSolver::spectral() const {
  return options_.method != DenseMethod::lu && options_.method != DenseMethod::qr;
}

bool DenseSolver::damps() const {
  return options_.method == DenseMethod::tikhonov_gcv ||
         options_.method == DenseMethod::tikhonov_l_curve;
}

std::string DenseSolver::factor(Eigen::MatrixXd a) {
  if (spectral()) return factor_spectral(std::move(a));
  if (options_.method == DenseMethod::lu) return factor_lu(std::move(a));
  factor_qr(std::move(a));
  return {};
}

std::string DenseSolver::factor_spectral(Eigen::MatrixXd a) {
  const double down_to = options_.method == DenseMethod::svd
                             ? options_.relative_cut
                             : std::numeric_limits<double>::epsilon();
  spectral_ = spectral_factors(std::move(a), down_to, options_.workers);
  if (!spectral_.message.empty()) return spectral_.message;
  const Eigen::VectorXd& s = spectral_.s;
  rank_ = static_cast<int>((s.array() > down_to * s(0)).count());
  const double least = s(s.size() - 1);
  condition_ = least > 0.0 ? s(0) / least : infinity;
  largest_gain_ = rank_ > 0 ? 1.0 / s(rank_ - 1) : 0.0;
  spectral_.u = spectral_.u.leftCols(rank_).eval();
  spectral_.v = spectral_.v.leftCols(rank_).eval();
  return {};
}

std::string DenseSolver::factor_lu(Eigen::MatrixXd a) {
  assert(rows_ == columns_);
  const double size = norm_of(a);
  lu_ = lapack::lu(std::move(a));
  if (lu_.singular) return "the matrix is singular: LU decomposition met a pivot of 0";
  rank_ = static_cast<int>(rows_);
  largest_gain_ = largest_singular_value(
      rows_,
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return lapack::lu_solve(lu_, x, false); },
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return lapack::lu_solve(lu_, x, true); });
  condition_ = size * largest_gain_;
  return {};
}

void DenseSolver::factor_qr(Eigen::MatrixXd a) {
  const double size = norm_of(a);
  qr_ = lapack::pivoted_qr(std::move(a));
  const Eigen::VectorXd diagonal = qr_.a.diagonal().cwiseAbs();
  rank_ = static_cast<int>((diagonal.array() > options_.relative_cut * diagonal(0)).count());
  const auto gain = [&](Eigen::Index n) {
    const auto r = qr_.a.topLeftCorner(n, n).triangularView<Eigen::Upper>();
    return largest_singular_value(
        n, [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return r.solve(x); },
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return r.transpose().solve(x); });
  };
  largest_gain_ = rank_ > 0 ? gain(rank_) : 0.0;
  condition_ = diagonal.minCoeff() > 0.0 ? size * gain(diagonal.size()) : infinity;
}

Eigen::MatrixXd DenseSolver::solve_directly(const Eigen::MatrixXd& b) const {
  if (options_.method == DenseMethod::lu) return lapack::lu_solve(lu_, b, false);
  const Eigen::Index columns = b.cols();
  const Eigen::MatrixXd rotated = lapack::apply_q_transposed(qr_, b).topRows(rank_);
  const Eigen::MatrixXd y =
      qr_.a.topLeftCorner(rank_, rank_).triangularView<Eigen::Upper>().solve(rotated);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(columns_, columns);
  for (Eigen::Index j = 0; j < rank_; ++j) x.row(qr_.columns(j) - 1) = y.row(j);
  return x;
}

DataSpectrum DenseSolver::spectrum_of(const Eigen::VectorXd& b) const {
  DataSpectrum data{spectral_.s.head(rank_), spectral_.u.transpose() * b, 0.0, rows_};
  data.outside_squared = (b - spectral_.u * data.coefficients).squaredNorm();
  return data;
}

double DenseSolver::regulariser(const Eigen::VectorXd& b) const {
  if (options_.method == DenseMethod::tikhonov_gcv) return gcv_regulariser(spectrum_of(b));
  if (options_.method == DenseMethod::tikhonov_l_curve) return l_curve_regulariser(spectrum_of(b));
  return 0.0;
}

Eigen::VectorXd DenseSolver::weights(double mu) const {
  const auto s = spectral_.s.head(rank_).array();
  return (s / (s.square() + mu * mu)).matrix();
}

DenseSolution DenseSolver::solve_with_figures(const Eigen::VectorXd& b) const {
  assert(b.size() == rows_);
  if (!ok()) return {Eigen::VectorXd::Constant(columns_, nan), nan, nan};
  DenseSolution solution;
  double gain = largest_gain_;
  if (spectral()) {
    solution.regulariser = rank_ > 0 ? regulariser(b) : 0.0;
    const Eigen::VectorXd w = weights(solution.regulariser);
    solution.x = spectral_.v * w.cwiseProduct(spectral_.u.transpose() * b);
    if (rank_ > 0) gain = w.maxCoeff();
  } else if (b.allFinite()) {
    solution.x = solve_directly(b);
  } else {
    // A pivot of zero times infinity and the columns left out would hide it.
    solution.x = Eigen::VectorXd::Constant(columns_, nan);
  }
  const double size = b.norm();
  solution.effective_condition = size == 0.0 ? 1.0 : gain * size / solution.x.norm();
  return solution;
}

Eigen::MatrixXd DenseSolver::solve_columns(const Eigen::MatrixXd& b) const {
  assert(b.rows() == rows_);
  if (!ok() || !b.allFinite()) return Eigen::MatrixXd::Constant(columns_, b.cols(), nan);
  if (!spectral()) return solve_directly(b);
  Eigen::MatrixXd coefficients = lapack::product(spectral_.u, b, true, options_.workers);
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    coefficients.col(j) =
        weights(rank_ > 0 ? regulariser(b.col(j)) : 0.0).cwiseProduct(coefficients.col(j)).eval();
  return lapack::product(spectral_.v, coefficients, false, options_.workers);
}

Eigen::VectorXd DenseSolver::leave_one_out(const Eigen::VectorXd& b) const {
  assert(rows_ == columns_);
  if (!ok() || !b.allFinite()) return Eigen::VectorXd::Constant(columns_, nan);
  // With every direction kept and none damped, taking out a row and its column [R99].
  if (options_.method == DenseMethod::lu || (rank_ == columns_ && !damps())) {
    const Eigen::VectorXd diagonal =
        spectral()
            ? Eigen::VectorXd(spectral_.v.cwiseProduct(spectral_.u) * weights(0.0))
            : Eigen::VectorXd(solve_directly(Eigen::MatrixXd::Identity(rows_, rows_)).diagonal());
    return solve(b).cwiseQuotient(diagonal);
  }
  // Else the data are fitted, b -> H b, in directions that one knot hardly changes.
  Eigen::MatrixXd directions;  // H = directions diag(kept) directions^T
  Eigen::VectorXd kept = Eigen::VectorXd::Ones(rank_);
  if (spectral()) {
    directions = spectral_.u;
    if (rank_ > 0) kept = weights(regulariser(b)).cwiseProduct(spectral_.s.head(rank_));
  } else {
    directions = lapack::apply_q_transposed(qr_, Eigen::MatrixXd::Identity(rows_, rows_))
                     .topRows(rank_)
                     .transpose();
  }
  const Eigen::VectorXd residual = b - directions * kept.cwiseProduct(directions.transpose() * b);
  const Eigen::VectorXd leverage = directions.cwiseAbs2() * kept;  // H_ii
  return residual.array() / (1.0 - leverage.array());
}

}  // namespace knotlight
