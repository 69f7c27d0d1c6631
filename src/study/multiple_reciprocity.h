// The boundary particle method [C02]: a source from its values on the boundary alone, no interior
// knots. It hopes that L = lap - lambda^2, applied to the source often enough, leaves nothing: with
//
//   u = sum_m sum_k beta_mk U_m(|x - x_k|),  m = 0 .. M,      L U_m = U_(m-1),  L U_0 = 0
//
// (U_m of bkm/kernel_batch.h), L^M f = 0 is taken for granted, and L^(M-1) f, .., L f, f at the
// knots x_k give beta_M, .., beta_1 one after the other with the one matrix U_0(|x_i - x_k|);
// beta_0 then meets the boundary condition.
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>

#include "bkm/dense_solver.h"
#include "core/shape.h"
#include "core/vec3.h"

namespace knotlight {

// The chain of one source: u at points, for any number of sources and boundary data.
class BoundaryParticles {
 public:
  // lambda: 1/length; k: length, of u + k du/dn = g.
  BoundaryParticles(double lambda, double k, SurfaceSamples knots);

  // chain: N x M, column m is L^m f at the knots, M = 1 .. max_order; g: N Robin values. Returns
  // the N x (M+1) weights.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& chain, const Eigen::VectorXd& g) const;
  // u of such weights at points.
  Eigen::VectorXd values(const Eigen::MatrixXd& weights, const Points& at) const;

  int rank() const { return waves_.rank(); }

 private:
  Eigen::MatrixXd matrix(const Points& at, const Points& normals, double k, int order) const;

  double lambda_, k_, size_;
  SurfaceSamples knots_;
  DenseSolver waves_;  // U_0 at the knots
  DenseSolver robin_;  // its Robin values
};

// The unscattered light of a lamp at distance D = 1 in front of a flat face,
//
//   exp(-sigma s)/r^2,   s = r - D/cos theta,
//
// and what powers of L make of it, all in closed form: sums of r^-a mu^-b exp(-sigma s) with mu =
// cos theta, which lap maps to each other.
class LampLight {
 public:
  explicit LampLight(double sigma);  // 1/length

  // L applied once more. lambda: 1/length.
  LampLight helmholtz(double lambda) const;
  // r > 0: from the lamp; mu in (0, 1].
  double value(double r, double mu) const;

 private:
  double sigma_;
  std::map<std::pair<int, int>, double> terms_;  // (a, b) -> its factor
};

// L^m of the Gaussian exp(-r^2/2h^2)/(2 pi h^2)^(3/2), of which densities are estimated; m = 0
// .. 3.
double gaussian_power(int m, double r_squared, double h, double lambda);

}  // namespace knotlight
