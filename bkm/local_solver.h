// The localized boundary knot method: the body in overlapping patches, each a boundary knot problem
// of its own with a few dozen knots, coupled by what its neighbours say on its inner border.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bkm/patch_tree.h"
#include "bkm/spherical_waves.h"

namespace knotlight {

struct LocalBkmOptions {
  int degree = 4;          // of the spherical waves in a patch: (degree + 1)^2 unknowns
  double cut = 1e-3;       // singular values of a patch below this part of its largest are dropped
  double residual = 1e-6;  // of the iteration over the patches, relative
  int most_iterations = 1000;
};

// A field of waves, one set per patch. Keeps the tree it was made on.
class LocalField {
 public:
  using Waves = std::shared_ptr<const std::vector<SphericalWaves>>;  // one set per patch

  // beta: coefficients of all patches, one patch after the other.
  LocalField(std::shared_ptr<const PatchTree> tree, BodyQueries body, Waves waves,
             Eigen::VectorXd beta);

  double value(const Vec3& x) const;
  // u + k du/dn at x with unit vector n; k: length.
  double robin(const Vec3& x, const Vec3& n, double k) const;

 private:
  std::shared_ptr<const PatchTree> tree_;
  BodyQueries body_;
  Waves waves_;
  Eigen::VectorXd beta_;
};

struct LocalSolution {
  Eigen::VectorXd beta;  // coefficients of all patches, one patch after the other
  int iterations = 0;
  double residual = 0.0;  // of the iteration, relative
  bool converged = false;
};

// What a solution leaves unsatisfied, per patch.
struct LocalMisfit {
  Eigen::VectorXd boundary;  // rms of g - (u + k du/dn) at its knots
  Eigen::VectorXd joints;    // rms difference from its neighbours at its joints
};

// Factors every patch once; solve() takes any number of boundary data.
class LocalBkmSolver {
 public:
  LocalBkmSolver(std::shared_ptr<const PatchTree> tree, const BodyQueries& body, double lambda,
                 double k, const LocalBkmOptions& options, const Workers& workers);

  // g: u + k du/dn at all knots of the tree (only those of patches are read).
  LocalSolution solve(const Eigen::VectorXd& g, const Workers& workers) const;
  // body: the same as that of the tree; it must outlive the field.
  LocalField field(const LocalSolution& solution, const BodyQueries& body) const;
  // Two solutions for independent estimates of the same data: the root of the mean product of their
  // residuals, in which noise averages out and only what the patches cannot represent is left.
  // Twice the same solution gives plain rms residuals.
  LocalMisfit misfit(const LocalSolution& a, const Eigen::VectorXd& g_a, const LocalSolution& b,
                     const Eigen::VectorXd& g_b, const Workers& workers) const;
  // Indices of the knots that solve() reads, increasing.
  std::vector<Eigen::Index> knots_used() const;
  std::size_t unknowns() const;

 private:
  struct System {
    Eigen::MatrixXd inverse;                 // unknowns x (knots + joints), of the weighted rows
    Eigen::VectorXd weights;                 // of the rows
    Eigen::MatrixXd rows;                    // unweighted, (knots + joints) x unknowns
    std::vector<std::ptrdiff_t> neighbours;  // per joint: the patch that owns it
    Eigen::MatrixXd neighbour_rows;          // unknowns of a neighbour x joints
  };
  void factor(std::size_t patch, const BodyQueries& body, double k);
  Eigen::VectorXd joint_values(const System& s, const Eigen::VectorXd& beta) const;
  Eigen::VectorXd knot_data(std::size_t patch, const Eigen::VectorXd& g) const;
  // g - (u + k du/dn) at the knots, then differences at the joints.
  Eigen::VectorXd residuals(std::size_t patch, const LocalSolution& solution,
                            const Eigen::VectorXd& g) const;
  void for_patches(const Workers& workers, const std::function<void(std::size_t)>& body) const;

  std::shared_ptr<const PatchTree> tree_;
  LocalBkmOptions options_;
  LocalField::Waves waves_;
  Eigen::Index size_;  // unknowns per patch
  std::vector<System> systems_;
};

}  // namespace knotlight
