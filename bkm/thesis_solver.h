// The boundary knot method as the thesis has it [V09 ch. 5.3, 6]: dual reciprocity with Gaussians
// for the source, the scaled non-singular solution for the rest, both systems by truncated SVD.
//
//   (lap - lambda^2) u = f inside,   u + k du/dn = g on the boundary, n outward,
//   u = sum_j alpha_j psi_j + sum_k beta_k G_k.
//
// Knows points, normals and numbers only.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "bkm/dense_solver.h"
#include "core/vec3.h"

namespace knotlight {

struct BkmThesisProblem {
  double lambda = 1.0;      // 1/length
  double k = 1.0;           // length
  Points boundary_points;   // 3 x N
  Points boundary_normals;  // 3 x N, outward unit
  Points interior_points;   // 3 x M
};

struct BkmThesisOptions {
  double c = 1.0;              // Gaussian width, length
  double relative_cut = -1.0;  // < 0: MATLAB's pinv rule
};

// A solved field; a sum of N + (N + M) kernels.
class BkmField {
 public:
  double value(const Vec3& x) const;
  Vec3 gradient(const Vec3& x) const;
  // Approximated source f~ = sum alpha phi at x: what dual reciprocity made of f.
  double source(const Vec3& x) const;
  // Values at many points, P.
  Eigen::VectorXd values(const Points& x) const;

 private:
  friend class BkmThesisSolver;
  Points gaussian_centers_;  // 3 x (N + M)
  Eigen::VectorXd alpha_;
  Points knots_;  // 3 x N
  Eigen::VectorXd beta_;
  double lambda_ = 1.0, c_ = 1.0, R_ = 1.0;
};

// Factors both systems once; solves for any number of sources and boundary data.
class BkmThesisSolver {
 public:
  BkmThesisSolver(const BkmThesisProblem& problem, const BkmThesisOptions& options);

  bool ok() const;
  std::string message() const;
  // f: N + M source values (boundary knots first, then interior points); g: N boundary values.
  BkmField solve(const Eigen::VectorXd& f, const Eigen::VectorXd& g) const;

  int particular_rank() const;
  int homogeneous_rank() const;
  double particular_condition() const;
  double homogeneous_condition() const;

 private:
  BkmThesisProblem problem_;
  BkmThesisOptions options_;
  double R_ = 1.0;
  Points centers_;
  std::unique_ptr<PseudoInverse> particular_;
  std::unique_ptr<PseudoInverse> homogeneous_;
};

}  // namespace knotlight
