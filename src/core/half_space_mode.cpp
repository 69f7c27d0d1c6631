#include "core/half_space_mode.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

// Lambda_l^m = sqrt((l - m)! / (l + m)!) P_l^m, |Lambda| <= 1, for l = m .. end - 1 (columns) at
// the cosines mu (rows); signs as without Condon and Shortley's.
MatrixXd associated_legendre(int m, int end, const VectorXd& mu) {
  MatrixXd p(mu.size(), end - m);
  p.col(0).setOnes();
  for (int k = 1; k <= m; ++k)
    p.col(0).array() *= std::sqrt((2.0 * k - 1.0) / (2.0 * k)) * (1.0 - mu.array().square()).sqrt();
  for (int l = m + 1; l < end; ++l) {
    p.col(l - m) = (2.0 * l - 1.0) * mu.cwiseProduct(p.col(l - m - 1));
    if (l > m + 1) p.col(l - m) -= std::sqrt((l - 1.0) * (l - 1.0) - m * m) * p.col(l - m - 2);
    p.col(l - m) /= std::sqrt(static_cast<double>(l) * l - static_cast<double>(m) * m);
  }
  return p;
}

}  // namespace

HalfSpaceStreams half_space_streams(int n) {
  const VectorXd diagonal = VectorXd::Zero(n);
  VectorXd beside(n - 1);
  for (int k = 1; k < n; ++k) beside[k - 1] = k / std::sqrt(4.0 * k * k - 1.0);
  Eigen::SelfAdjointEigenSolver<MatrixXd> jacobi;
  jacobi.computeFromTridiagonal(diagonal, beside);
  return {0.5 * (jacobi.eigenvalues().array() + 1.0),
          jacobi.eigenvectors().row(0).transpose().array().square()};
}

MatrixXd half_space_mode(const HalfSpaceStreams& streams, double albedo, const VectorXd& moments,
                         int m, const VectorXd& mu) {
  const int end = static_cast<int>(moments.size());
  const MatrixXd at_nodes =
      (streams.weight.array() / streams.mu.array()).sqrt().matrix().asDiagonal() *
      associated_legendre(m, end, streams.mu);  // lambda_l
  const MatrixXd at_mu = associated_legendre(m, end, mu);

  // albedo (2 l + 1) g^l, of even or odd l + m only; the column l - m has the parity of l + m.
  VectorXd even = VectorXd::Zero(end - m);
  VectorXd odd = even;
  for (int l = m; l < end; ++l)
    ((l - m) % 2 == 0 ? even : odd)[l - m] = albedo * (2 * l + 1) * moments[l];
  const MatrixXd inverse_mu = streams.mu.cwiseInverse().asDiagonal();
  const MatrixXd e = inverse_mu - at_nodes * even.asDiagonal() * at_nodes.transpose();
  const MatrixXd o = inverse_mu - at_nodes * odd.asDiagonal() * at_nodes.transpose();

  // What decays as exp(-k tau): s = L v, t = k L^-T v, where O = L L^T and L^T E L v = k^2 v.
  const Eigen::LLT<MatrixXd> cholesky(o);
  const MatrixXd l = cholesky.matrixL();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> decay(l.transpose() * e * l);
  // Rounding can leave the 0 of albedo 1 below 0.
  const VectorXd k = decay.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const MatrixXd s = l * decay.eigenvectors();
  const MatrixXd t = cholesky.matrixU().solve(decay.eigenvectors()) * k.asDiagonal();

  // Light that leaves at mu: int source(tau) exp(-tau / mu) dtau / mu, of every decaying solution;
  // then of the combination of them that has light coming in at one node only.
  MatrixXd leaving = 0.5 * (at_mu * even.asDiagonal() * (at_nodes.transpose() * s) -
                            at_mu * odd.asDiagonal() * (at_nodes.transpose() * t));
  leaving.array() /= 1.0 + (mu * k.transpose()).array();
  const MatrixXd arriving = 0.5 * (s + t);
  const MatrixXd response =  // 2 pi rho_m(mu, mu_i) sqrt(w_i mu_i)
      arriving.transpose().partialPivLu().solve(leaving.transpose()).transpose();

  // phi_l = Lambda_l + excess_l. The sum of phi_l phi_l without Lambda_l Lambda_l, which is the
  // light scattered once.
  const VectorXd signed_moments = even - odd;
  MatrixXd excess = mu.asDiagonal() * (response * at_nodes);
  for (int column = 1; column < end - m; column += 2) excess.col(column) *= -1.0;
  const MatrixXd once = excess * signed_moments.asDiagonal() * at_mu.transpose();
  const MatrixXd twice = excess * signed_moments.asDiagonal() * excess.transpose();
  return (once + once.transpose() + twice) / (4.0 * pi);
}

}  // namespace knotlight
