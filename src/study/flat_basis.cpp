#include "study/flat_basis.h"

#include <Eigen/QR>
#include <cmath>

namespace knotlight {

// Downwards from far beyond the top, 1/rho_(l-1) = (2l+1)/x + rho_l [AS64 10.2.18]: all terms are
// positive, and what one starts with is forgotten.
Eigen::VectorXd bessel_ratios(double x, int top) {
  constexpr int beyond = 40;  // steps, each forgetting a factor x^2/(2l+1)^2 or better of the start
  Eigen::VectorXd ratios(top);
  double ratio = 0.0;
  for (int l = top + beyond + static_cast<int>(x); l > 0; --l) {
    ratio = 1.0 / ((2.0 * l + 1.0) / x + ratio);
    if (l <= top) ratios[l - 1] = ratio;
  }
  return ratios;
}

FlatBasis::FlatBasis(const Points& centers, double lambda, double rho, int degree)
    : waves_(degree, lambda, rho) {
  const Eigen::Index n = centers.cols(), all = waves_.size();
  Eigen::MatrixXd c(n, all);
  Eigen::VectorXd row(all);
  for (Eigen::Index i = 0; i < n; ++i) {
    waves_.values(centers.col(i), row);
    c.row(i) = row.transpose();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(c);
  const Eigen::MatrixXd& r = qr.matrixQR();
  const Eigen::VectorXd ratios = bessel_ratios(lambda * rho, degree);
  const auto degree_of = [](Eigen::Index j) {
    return static_cast<Eigen::Index>(std::sqrt(static_cast<double>(j) + 0.5));
  };
  tail_ = r.leftCols(n).triangularView<Eigen::Upper>().solve(r.rightCols(all - n)).transpose();
  for (Eigen::Index j = 0; j < all - n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      double quotient = 1.0;  // d of wave n + j over that of wave i
      for (Eigen::Index l = degree_of(i); l < degree_of(n + j); ++l)
        quotient *= -ratios[l] * ratios[l];
      tail_(j, i) *= quotient;
    }
}

Eigen::MatrixXd FlatBasis::matrix(const Points& points, const Points* normals, double k) const {
  Eigen::MatrixXd w(points.cols(), waves_.size());
  Eigen::VectorXd row(waves_.size());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (normals != nullptr)
      waves_.robin(points.col(i), normals->col(i), k, row);
    else
      waves_.values(points.col(i), row);
    w.row(i) = row.transpose();
  }
  const Eigen::Index n = tail_.cols();
  return w.leftCols(n) + w.rightCols(w.cols() - n) * tail_;
}

}  // namespace knotlight
