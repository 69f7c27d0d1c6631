// One dense least-squares system for the whole boundary: the homogeneous part as a sum over global
// basis functions, either the boundary knots' non-singular solutions or sources outside the body.
#pragma once

#include <Eigen/Core>
#include <string>

#include "bkm/lapack.h"
#include "core/parallel.h"
#include "core/vec3.h"

namespace knotlight {

enum class GlobalBasis {
  nonsingular_solutions,  // sinh(lambda r)/(lambda r) about points on the surface: the BKM [CT00]
  exterior_sources,       // exp(-lambda r)/r about points outside: the method of fundamental
                          // solutions [KA64]
};

struct GlobalBkmProblem {
  double lambda = 1.0;  // 1/length
  double k = 1.0;       // length
  Points centers;       // 3 x N: on the surface, or outside
  // 3 x M, M >= N: where the Robin condition is asked for, with outward unit normals.
  Points knots;
  Points normals;
};

// The field of one solution.
class GlobalField {
 public:
  GlobalField() = default;
  GlobalField(GlobalBasis basis, double lambda, Points centers, Eigen::VectorXd coefficients);

  double value(const Vec3& x) const;
  double robin(const Vec3& x, const Vec3& n, double k) const;
  const Eigen::VectorXd& coefficients() const { return coefficients_; }

 private:
  GlobalBasis basis_ = GlobalBasis::nonsingular_solutions;
  double lambda_ = 1.0;
  double R_ = 0.0;  // scale of the non-singular solutions, length
  Points centers_;
  Eigen::VectorXd coefficients_;
};

// Rank-revealing QR of the M x N matrix of Robin values, kept for any number of right-hand sides.
class GlobalBkmSolver {
 public:
  // cut: pivots below this part of the largest are dropped. Columns are scaled to one size first,
  // so that the cut means the same for both bases.
  GlobalBkmSolver(GlobalBkmProblem problem, GlobalBasis basis, double cut, const Workers& workers);

  // g: M values of u + k du/dn, W/(length^2 sr).
  GlobalField solve(const Eigen::VectorXd& g) const;
  const GlobalBkmProblem& problem() const { return problem_; }
  Eigen::Index rank() const { return rank_; }
  // Largest over smallest pivot, of all columns: within a small factor the condition number.
  double condition() const;

 private:
  GlobalBkmProblem problem_;
  GlobalBasis basis_;
  Eigen::VectorXd scales_;  // of the columns
  lapack::PivotedQr qr_;
  Eigen::Index rank_ = 0;
};

}  // namespace knotlight
