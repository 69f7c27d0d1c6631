// A multigrid V-cycle as a symmetric positive definite preconditioner, and conjugate gradients.
#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <vector>

#include "grid/operator.h"

namespace knotlight {

class Multigrid {
 public:
  // `levels`, finest first, must outlive this.
  Multigrid(const std::vector<Level>& levels, const OperatorCoefficients& coefficients);

  const GridOperator& finest() const { return stages_.front()->matrix; }

  // Room for one V-cycle at a time; make one per thread.
  struct Workspace {
    struct Vectors {
      Eigen::VectorXd rhs, x, residual, direction;
    };
    std::vector<Vectors> levels;
  };
  Workspace workspace() const;
  // z = B r, one V-cycle from zero.
  void precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z, Workspace& work) const;

 private:
  // Where an unknown lies in the coarser grid: corner weights of `piece` there; code = x + 3 y + 9
  // z in half edges.
  struct Parent {
    std::int32_t piece;
    std::int32_t code;
  };
  struct Stage {
    Stage(const Level& l, const OperatorCoefficients& c, double fineness)
        : level(l), matrix(l, c, fineness) {}
    const Level& level;
    GridOperator matrix;
    Eigen::VectorXd inverse_diagonal;
    double largest_eigenvalue = 0.0;  // of D^-1 A, an upper estimate
    std::vector<Parent> parents;      // empty on the coarsest
  };

  static std::vector<Parent> parents(const Level& fine, const Level& coarse);
  static double largest_eigenvalue(const Stage& stage);
  static void smooth(const Stage& stage, Workspace::Vectors& v);
  void cycle(std::size_t at, Workspace& work) const;

  std::vector<std::unique_ptr<Stage>> stages_;
  Eigen::LDLT<Eigen::MatrixXd> coarsest_;
};

struct ConjugateGradientResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  // |b - A x| / |b|; not finite if the data were not
  bool converged = false;
};

// Solves A x = b to |b - A x| <= tolerance |b|. Serial: the same bits every time.
ConjugateGradientResult solve(const Multigrid& multigrid, const Eigen::VectorXd& b,
                              double tolerance, int max_iterations);

}  // namespace knotlight
