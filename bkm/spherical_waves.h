// Solutions of lap u = lambda^2 u without singularity about a centre: spherical waves of degree
// 0 .. L. They span what sinh(lambda r)/(lambda r) about any number of knots around the centre
// spans to working precision (README.md, rank), but as a well-conditioned basis.
#pragma once

#include <Eigen/Core>

#include "core/vec3.h"

namespace knotlight {

// (L+1)^2 functions w(x) = (i_l(lambda r) / i_l(lambda rho)) Y_lm(x/r), i_l the modified spherical
// Bessel function of the first kind, Y_lm real and of rms 1 on spheres: of size 1 on the sphere of
// radius rho, so matrices of them need no scaling. lambda >= 0; lambda = 0 gives solid harmonics.
class SphericalWaves {
 public:
  // degree 0..20; lambda: 1/length; rho: length. lambda rho up to some hundreds: terms of the
  // series in between grow as exp(lambda rho).
  SphericalWaves(int degree, double lambda, double rho);

  Eigen::Index size() const { return (degree_ + 1) * (degree_ + 1); }
  double rho() const { return rho_; }

  // Row of values at x, relative to the centre; row: size().
  void values(const Vec3& x, Eigen::Ref<Eigen::VectorXd> row) const;
  // Row of u + k du/dn at x with unit vector n; k: length.
  void robin(const Vec3& x, const Vec3& n, double k, Eigen::Ref<Eigen::VectorXd> row) const;
  // sum_j beta_j w_j(x), and its gradient.
  double sum(const Vec3& x, const Eigen::Ref<const Eigen::VectorXd>& beta) const;
  Vec3 gradient(const Vec3& x, const Eigen::Ref<const Eigen::VectorXd>& beta) const;

 private:
  static constexpr int max_degree = 20;
  static constexpr int max_size = (max_degree + 1) * (max_degree + 1);
  // Values, and where gradients is not null the 3 x size() gradients.
  void evaluate(const Vec3& x, double* value, double* gradient) const;

  int degree_;
  double lambda_, rho_;
  double scale_[max_degree + 1];                      // 1 / s_l at rho
  double norm_[max_degree + 1][max_degree + 1] = {};  // of Y_lm, [l][m]
};

}  // namespace knotlight
