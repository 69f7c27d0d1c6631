// One Fourier mode, in azimuth, of the light that a half-space reflects.
//
// With N directions per hemisphere (Gauss nodes mu_i, weights w_i) the transfer equation is a
// linear system for the light going down, d_i, and up, u_i, each in units of 1/sqrt(w_i mu_i). In
// terms of s = d + u and t = d - u it reads
//
//   t' = -E s,   s' = -O t,   E, O = 1/mu - albedo sum_l (2 l + 1) g^l lambda_l lambda_l^T,
//   lambda_l(i) = Lambda_l^m(mu_i) sqrt(w_i / mu_i),
//
// E with the sum over even and O over odd l + m; Lambda are the associated Legendre functions. Both
// matrices are symmetric and O is positive definite. What decays with depth obeys t = Z s where
// Z O Z = E: Z is the geometric mean of O^-1 and E, the half-space's admittance, and its reflection
// is u = (1 - Z) (1 + Z)^-1 d. Nothing is iterated, and albedo 1 (E singular) is no exception.
//
// Between the nodes: by the principle of invariance the reflection is a sum of products of
// functions of one cosine [Ch60 ch. IV],
//
//   (mu + mu0) rho_m = albedo / (4 pi) sum_l (-1)^(l+m) (2 l + 1) g^l phi_l(mu) phi_l(mu0),
//   phi_l(mu) = Lambda_l(mu) + (-1)^(l+m) 2 pi mu int_0^1 rho_m(mu, nu) Lambda_l(nu) dnu
//
// (isotropic scattering has one of them, Chandrasekhar's H), and the light that leaves at a mu that
// is no node follows from the source inside by one quadrature in depth, done in closed form.
#pragma once

#include <Eigen/Core>

namespace knotlight {

struct HalfSpaceStreams {
  Eigen::VectorXd mu, weight;  // Gauss-Legendre on (0, 1), weights adding up to 1
};
// n >= 1 directions per hemisphere: eigenvalues of the Jacobi matrix [GW69].
HalfSpaceStreams half_space_streams(int n);

// (mu_a + mu_b) rho_m(mu_a, mu_b) of the light scattered at least twice (1/sr), symmetric, at the
// cosines `mu` in [0, 1]; rho = rho_0 + 2 sum_m rho_m cos(m phi). `moments`: g^l for l < 2 N.
// albedo in [0, 1], 0 <= m < 2 N.
Eigen::MatrixXd half_space_mode(const HalfSpaceStreams& streams, double albedo,
                                const Eigen::VectorXd& moments, int m, const Eigen::VectorXd& mu);

}  // namespace knotlight
