// The matrix of the method on one grid, applied without being stored:
//   A_ij = int grad N_i . grad N_j + lambda^2 int N_i N_j + (1/k) int_surface N_i N_j + P_ij.
// Away from the surface all rows are the same 27 numbers; near it cells are added one by one.
// P holds cells that are hardly filled to their neighbours: over each face of such a cell it
// penalises the jump of the normal derivative, gamma h int_face [d_n u]^2 [B10]. It vanishes for
// linear fields, and for constants in particular, so energy is conserved.
#pragma once

#include <vector>

#include "grid/level.h"

namespace knotlight {

struct OperatorCoefficients {
  double lambda = 0.0;  // >= 0, 1/length
  double k = 1.0;       // > 0, length
  // gamma, with h of the finest grid. On the sphere lit by a beam (tests/grid) 0.5 halves the error
  // that 0.1 leaves in cells that are hardly filled; beyond 1 it grows again, and so does the work.
  double penalty = 0.5;
};

class GridOperator {
 public:
  // `level` must outlive the operator. fineness: cell size over the finest grid's.
  GridOperator(const Level& level, const OperatorCoefficients& coefficients, double fineness);

  std::int32_t size() const { return level_.dofs; }
  // y = A x; not the same vector.
  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  // An unknown whose row is zero (a piece without volume, surface and neighbours) has 0 here.
  const Eigen::VectorXd& diagonal() const { return diagonal_; }

 private:
  // Unknowns first .. first + count - 1 are neighbours along x with whole cells all around; row r =
  // (dy+1) + 3 (dz+1) of their neighbours starts at rows[r].
  struct Run {
    std::int32_t first, count;
    std::array<std::int32_t, 9> rows;
  };
  struct Element {
    std::int32_t piece;
    std::int32_t matrix;  // -1: the whole cell's
  };
  // Unknowns on the three planes x = -1, 0, 1 across a penalised face.
  struct Face {
    std::array<std::array<std::int32_t, 4>, 3> dof;
  };

  void find_runs();
  void find_elements(const OperatorCoefficients& coefficients);
  void find_faces();
  void apply_runs(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  void find_diagonal();

  const Level& level_;
  ElementMatrix whole_;
  std::array<double, 4> stencil_{};  // by the number of axes along which the neighbour differs
  double penalty_ = 0.0;             // times the face's matrix: length
  std::vector<Run> runs_;
  std::vector<std::uint8_t> in_run_;  // per unknown
  std::vector<Element> elements_;
  std::vector<ElementMatrix> matrices_;
  std::vector<Face> faces_;
  Eigen::VectorXd diagonal_;
};

}  // namespace knotlight
