// A multigrid V-cycle as a symmetric positive definite preconditioner, and conjugate gradients.
#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <vector>

#include "grid/operator.h"

namespace knotlight {

// The V-cycle works in float: a preconditioner need not be exact, and so it moves half the memory.
// A x, which decides about the solution, is in double.
class Multigrid {
 public:
  // `levels`, finest first, must outlive this.
  Multigrid(const std::vector<Level>& levels, const OperatorCoefficients& coefficients);

  // Systems can be solved on the finest grid (at = 0) and, where there is one, on the next (1),
  // whose penalty goes by its own cells as if it were the finest.
  const GridOperator<double>& matrix(std::size_t at) const { return matrices_[at]; }
  std::size_t systems() const { return matrices_.size(); }

  // Between these two, by the shape functions of the coarser grid: the transposed of each other.
  Eigen::VectorXd prolonged(const Eigen::VectorXd& coarse) const;
  Eigen::VectorXd restricted(const Eigen::VectorXd& fine) const;

  // Room for one V-cycle at a time; make one per thread.
  struct Workspace {
    struct Vectors {
      Eigen::VectorXf rhs, x, residual, direction, product;
    };
    std::vector<Vectors> levels;
  };
  Workspace workspace() const;

  // z = B r, one V-cycle from zero. B is symmetric up to the rounding of float.
  void precondition(std::size_t at, const Eigen::VectorXd& r, Eigen::VectorXd& z,
                    Workspace& work) const;

 private:
  // Where an unknown lies in the coarser grid: corner weights of `piece` there; code = x + 3 y + 9
  // z in half edges.
  struct Parent {
    std::int32_t piece;
    std::int32_t code;
  };
  struct Stage {
    Stage(const Level& l, GridOperator<float> m) : level(l), matrix(std::move(m)) {}
    const Level& level;
    GridOperator<float> matrix;
    Eigen::VectorXf inverse_diagonal;
    float largest_eigenvalue = 0.0F;  // of D^-1 A, an upper estimate
    std::vector<Parent> parents;      // empty on the coarsest
  };
  static std::vector<Parent> parents(const Level& fine, const Level& coarse);
  static float largest_eigenvalue(const Stage& stage);
  static void smooth(const Stage& stage, Workspace::Vectors& v);
  template <class Vector>
  void restrict_from(std::size_t at, const Vector& fine, Vector& coarse) const;
  template <class Vector>
  void prolong_to(std::size_t at, const Vector& coarse, Vector& fine) const;
  void cycle(std::size_t at, Workspace& work) const;

  std::vector<GridOperator<double>> matrices_;
  std::vector<Stage> stages_;
  Eigen::LDLT<Eigen::MatrixXd> coarsest_;
};

struct ConjugateGradientResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  // |b - A x| / |b|; not finite if the data were not
  bool converged = false;
};

// Solves A x = b on the grid `at` to |b - A x| <= tolerance |b|, from `start`, or from zero if that
// is empty. Serial: the same bits every time.
ConjugateGradientResult solve(const Multigrid& multigrid, std::size_t at, const Eigen::VectorXd& b,
                              const Eigen::VectorXd& start, double tolerance, int max_iterations);

}  // namespace knotlight
