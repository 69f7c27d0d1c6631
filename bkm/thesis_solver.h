// The boundary knot method as the thesis has it [V09 ch. 5.3, 6]: dual reciprocity with Gaussians
// for the source, the scaled non-singular solution for the rest, both systems by truncated SVD.
//
//   (lap - lambda^2) u = f inside,   u + k du/dn = g on the boundary, n outward,
//   u = sum_j alpha_j psi_j + sum_k beta_k G_k.
//
// Knows points, normals and numbers only.
#pragma once

#include <Eigen/Core>
#include <string>

#include "bkm/dense_solver.h"
#include "bkm/field.h"
#include "core/vec3.h"

namespace knotlight {

struct BkmThesisProblem {
  double lambda = 1.0;      // >= 0, 1/length
  double k = 1.0;           // >= 0, length; 0 is Dirichlet's condition
  Points boundary_points;   // 3 x N, N >= 1
  Points boundary_normals;  // 3 x N, outward unit
  Points interior_points;   // 3 x M
};

struct BkmThesisOptions {
  double c = 1.0;              // Gaussian width, length
  double relative_cut = -1.0;  // < 0: MATLAB's pinv rule
};

// Factors both systems once; solves for any number of sources and boundary data. Objects may be
// made and used in several threads at once.
class BkmThesisSolver {
 public:
  BkmThesisSolver(const BkmThesisProblem& problem, const BkmThesisOptions& options);

  bool ok() const { return particular_.ok() && homogeneous_.ok(); }
  std::string message() const;  // which system failed and why; empty if ok
  // f: N + M source values (boundary knots first, then interior points); g: N boundary values.
  // If not ok(), or with data that are not finite, the field is NaN everywhere.
  BkmField solve(const Eigen::VectorXd& f, const Eigen::VectorXd& g) const;

  int particular_rank() const { return particular_.rank(); }
  int homogeneous_rank() const { return homogeneous_.rank(); }
  double particular_condition() const { return particular_.condition(); }
  double homogeneous_condition() const { return homogeneous_.condition(); }

 private:
  BkmBasis basis_;
  Points knots_, normals_;  // 3 x N
  double k_;
  PseudoInverse particular_;   // (N + M) x (N + M)
  PseudoInverse homogeneous_;  // N x N
};

}  // namespace knotlight
