// A solved field: the sum of radial functions and non-singular solutions of [V09 5.29], its
// gradient and its source.
#pragma once

#include <Eigen/Core>

#include "bkm/radial_functions.h"
#include "core/vec3.h"

namespace knotlight {

// Where the kernels sit and what they are; the coefficients are the field's.
struct BkmBasis {
  PointColumns centers;        // (N + M) x 3, of the particular functions
  RadialFunction particular;   // psi of dual reciprocity
  PointColumns knots;          // N x 3
  RadialFunction homogeneous;  // U_m: nonsingular, of order 0 in the plain method
  DistancePrecision precision = DistancePrecision::double_precision;
};

// u(x) = sum_j alpha_j psi(|x - x_j|) + sum_k beta_k U_m(|x - x_k|). Default: the empty sum, 0.
// Sums are taken in the order of the kernels: value() and values() have the same bits.
class BkmField {
 public:
  BkmField() = default;
  // alpha: one per centre; beta: one per knot. Either may be empty: that part is 0.
  BkmField(BkmBasis basis, Eigen::VectorXd alpha, Eigen::VectorXd beta);

  double value(const Vec3& x) const;
  Vec3 gradient(const Vec3& x) const;
  // Left side of the Robin condition, u + k du/dn, at x with outward unit normal n; k: length.
  double robin(const Vec3& x, const Vec3& n, double k) const;
  // Approximated source f~ = sum alpha phi + sum beta U_(m-1) at x: what the basis made of f. The
  // field obeys (lap - lambda^2) u = f~ exactly.
  double source(const Vec3& x) const;
  // Values at P points.
  Eigen::VectorXd values(const Points& x) const;

  const Eigen::VectorXd& alpha() const { return alpha_; }
  const Eigen::VectorXd& beta() const { return beta_; }

 private:
  BkmBasis basis_;
  Eigen::VectorXd alpha_;  // N + M
  Eigen::VectorXd beta_;   // N
};

}  // namespace knotlight
