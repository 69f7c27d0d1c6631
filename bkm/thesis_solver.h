// The boundary knot method as the thesis has it [V09 ch. 5.3, 6]: dual reciprocity with radial
// functions for the source, scaled non-singular solutions for the rest, both systems dense.
//
//   (lap - lambda^2) u = f inside,   u + k du/dn = g on the boundary, n outward,
//   u = sum_j alpha_j psi_j + sum_k beta_k U_m,k.
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
  double c = 1.0;              // width of the radial function, length
  double relative_cut = -1.0;  // < 0: MATLAB's pinv rule
  RadialKind radial = RadialKind::gaussian;
  double exponent = 1.0;  // b > 0 of the two multiquadrics
  int radial_order = 1;   // m of RadialKind::nonsingular, 1..max_order
  // Order m of the boundary basis, 0..max_order. U_m with m > 0 has the source U_(m-1), which dual
  // reciprocity takes away: what the basis holds for every knot is U_m - sum_j C_j psi_j, with C
  // such that sum_j C_j phi_j is U_(m-1) at all knots.
  int basis_order = 0;
  DenseMethod solver = DenseMethod::svd;
  DistancePrecision precision = DistancePrecision::double_precision;
  Workers workers = Workers(1);  // the same bits for any number
};

// The radial function the options name, for bodies of this lambda and size R (length).
RadialFunction radial_function(const BkmThesisOptions& options, double lambda, double R);
// The largest distance between two of the points, length.
double diameter(const Points& points);
// Boundary knots, then interior points.
Points all_points(const BkmThesisProblem& problem);

// How the two systems of one solve came out; NaN if not ok().
struct BkmSolveFigures {
  double particular_effective_condition = 0.0, homogeneous_effective_condition = 0.0;
  double particular_regulariser = 0.0, homogeneous_regulariser = 0.0;
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
  BkmField solve(const Eigen::VectorXd& f, const Eigen::VectorXd& g,
                 BkmSolveFigures& figures) const;

  int particular_rank() const { return particular_.rank(); }
  int homogeneous_rank() const { return homogeneous_.rank(); }
  double particular_condition() const { return particular_.condition(); }
  double homogeneous_condition() const { return homogeneous_.condition(); }

 private:
  Eigen::MatrixXd boundary_matrix(const BkmThesisProblem& problem,
                                  const BkmThesisOptions& options) const;

  BkmBasis basis_;
  Points knots_, normals_;  // 3 x N
  double k_;
  DenseSolver particular_;   // (N + M) x (N + M)
  Eigen::MatrixXd carried_;  // C, (N + M) x N; empty if basis_order = 0
  DenseSolver homogeneous_;  // N x N
};

}  // namespace knotlight
