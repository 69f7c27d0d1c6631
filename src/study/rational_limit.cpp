#include "study/rational_limit.h"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

// Functions that the denominator is fitted to: beyond some dozens more of them say nothing new.
constexpr Eigen::Index most_fitted = 60;

// Real and imaginary parts, one below the other: for real coefficients.
Eigen::MatrixXd both_parts(const Eigen::MatrixXcd& a) {
  Eigen::MatrixXd parts(2 * a.rows(), a.cols());
  parts << a.real(), a.imag();
  return parts;
}

}  // namespace

Eigen::VectorXcd half_circle(int count) {
  Eigen::VectorXcd z(count);
  for (int k = 0; k < count; ++k) z[k] = std::polar(1.0, std::numbers::pi * (k + 0.5) / count);
  return z;
}

// a_i(z) - u_i(z) (b(z) - 1) = u_i(z), b(0) = 1. For each i the part of the equations that no a_i
// can meet speaks of b alone: those parts of all i together give b, then each i its a_i.
Eigen::VectorXd rational_limit(const Eigen::MatrixXcd& on_circle, double z) {
  const Eigen::Index points = on_circle.cols(), functions = on_circle.rows();
  const Eigen::Index poles = points / 2, numerator = 2 * points - poles;  // terms of a_i
  const Eigen::VectorXcd circle = half_circle(static_cast<int>(points));
  Eigen::MatrixXcd powers(points, numerator);
  powers.col(0).setOnes();
  for (Eigen::Index j = 1; j < numerator; ++j)
    powers.col(j) = powers.col(j - 1).cwiseProduct(circle);

  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(both_parts(powers));
  const Eigen::MatrixXd r = qr.matrixQR().topRows(numerator);
  const Eigen::Index fitted = std::min(functions, most_fitted);
  Eigen::MatrixXd system(fitted * poles, poles);
  Eigen::VectorXd right(fitted * poles);
  for (Eigen::Index f = 0; f < fitted; ++f) {
    const Eigen::VectorXcd u = on_circle.row(f * functions / fitted).transpose();
    const double scale = 1.0 / u.cwiseAbs().maxCoeff();
    const Eigen::MatrixXcd products = scale * (u.asDiagonal() * powers.leftCols(poles + 1));
    const Eigen::MatrixXd rotated =
        (qr.householderQ().adjoint() * both_parts(products)).bottomRows(poles);
    system.middleRows(f * poles, poles) = rotated.rightCols(poles);
    right.segment(f * poles, poles) = -rotated.col(0);
  }
  Eigen::VectorXd b(poles + 1);
  b << 1.0, system.colPivHouseholderQr().solve(right);

  const Eigen::VectorXcd denominator = powers.leftCols(poles + 1) * b;
  const Eigen::MatrixXcd products =
      (on_circle.transpose().array().colwise() * denominator.array()).matrix();
  const Eigen::MatrixXd rotated = qr.householderQ().adjoint() * both_parts(products);
  const Eigen::MatrixXd a =
      r.leftCols(numerator).triangularView<Eigen::Upper>().solve(rotated.topRows(numerator));
  Eigen::VectorXd at(numerator);
  at[0] = 1.0;
  for (Eigen::Index j = 1; j < numerator; ++j) at[j] = at[j - 1] * z;
  return a.transpose() * at / b.dot(at.head(poles + 1));
}

}  // namespace knotlight
