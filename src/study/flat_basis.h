// What the boundary knot method's functions become when their condition is taken out by hand.
//
// About a centre, with the spherical waves w_j of bkm/spherical_waves.h (size 1 at radius rho),
//
//   sinh(lambda |x - y|)/(lambda |x - y|) = sum_j d_j w_j(x) w_j(y),
//   d_j = (-1)^l i_l(lambda rho)^2
//
// ([AS64 10.1.45] for imaginary arguments): all of the ill condition is in the diagonal d, and that
// is known in closed form. As for Gaussians on a sphere [FP07]: let C = w_j(y_i) = Q R, R = [R1
// R2]; then the N functions
//
//   psi_i(x) = w_i(x) + sum_(j > N) (R1^-1 R2)_ij (d_j/d_i) w_j(x)
//
// span exactly what sinh(lambda r)/(lambda r) about the N points y_i span, with no d_i left to
// divide by.
#pragma once

#include <Eigen/Core>

#include "bkm/spherical_waves.h"
#include "core/vec3.h"

namespace knotlight {

class FlatBasis {
 public:
  // centers: 3 x N around the origin, at most rho away, N <= (degree + 1)^2; lambda > 0, 1/length.
  // Waves of higher degree are left out.
  FlatBasis(const Points& centers, double lambda, double rho, int degree);

  // psi_i at points, M x N; Robin values psi_i + k dpsi_i/dn with normals (outward unit).
  Eigen::MatrixXd matrix(const Points& points, const Points* normals, double k) const;

 private:
  SphericalWaves waves_;
  Eigen::MatrixXd tail_;  // (K - N) x N: d_j (R1^-1 R2)_ij / d_i
};

// i_(l+1)(x) / i_l(x) for l = 0 .. top - 1, x > 0.
Eigen::VectorXd bessel_ratios(double x, int top);

}  // namespace knotlight
