// The value of vector-valued functions where they cannot be computed, from where they can: RBF-RA
// [WF17], the successor of Contour-Pade [FW04].
//
// M functions u_i(z) with poles in common, real on the real axis, known on the circle |z| = 1: fit
// u_i = a_i(z) / b(z), polynomials of degrees m and n with one b for all, by least squares over the
// circle, and evaluate inside.
#pragma once

#include <Eigen/Core>

namespace knotlight {

// z_k = exp(i pi (k + 1/2)/K), k = 0 .. K - 1: with their conjugates 2 K points on the circle.
Eigen::VectorXcd half_circle(int count);

// on_circle: M x K, u_i(z_k) at half_circle(K); z real, |z| < 1. n = K/2 poles, m = 2K - 1 - n as
// [WF17] has them. Returns M values.
Eigen::VectorXd rational_limit(const Eigen::MatrixXcd& on_circle, double z);

}  // namespace knotlight
