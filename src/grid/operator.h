// The matrix of the method on one grid, applied without being stored:
//   A_ij = int grad N_i . grad N_j + lambda^2 int N_i N_j + (1/k) int_surface N_i N_j + P_ij.
// Away from the surface all rows are the same 27 numbers; near it cells are added one by one.
// P holds cells that are hardly filled to their neighbours: over each face of such a cell it
// penalises the jump of the normal derivative, gamma h int_face [d_n u]^2 [B10]. It vanishes for
// linear fields, and for constants in particular, so energy is conserved.
#pragma once

#include <Eigen/StdVector>
#include <memory>
#include <vector>

#include "grid/pattern.h"

namespace knotlight {

struct OperatorCoefficients {
  double lambda = 0.0;  // >= 0, 1/length
  double k = 1.0;       // > 0, length
  // gamma, with h of the finest grid. On the sphere lit by a beam (tests/grid) 0.5 halves the error
  // that 0.1 leaves in cells that are hardly filled; beyond 1 it grows again, and so does the work.
  double penalty = 0.5;
};

// Real: double, or float for preconditioners, which moves half the memory.
template <class Real>
class GridOperator {
 public:
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  // fineness: cell size over the finest grid's.
  GridOperator(const Level& level, const OperatorCoefficients& coefficients, double fineness);
  // The same times `scale`, a factor that keeps the entries within the range of float.
  template <class Other>
  GridOperator(const GridOperator<Other>& other, double scale);

  std::int32_t size() const { return pattern_->unknowns; }
  // y = A x; not the same vector.
  void apply(const Vector& x, Vector& y) const;
  // An unknown whose row is zero (a piece without volume, surface and neighbours) has 0 here.
  const Vector& diagonal() const { return diagonal_; }

 private:
  template <class>
  friend class GridOperator;
  using Element = Eigen::Matrix<Real, 8, 8>;

  void apply_runs(const Vector& x, Vector& y) const;
  void find_diagonal();

  std::shared_ptr<const GridPattern> pattern_;
  Element whole_;
  std::array<Real, 4> stencil_{};      // by the number of axes along which the neighbour differs
  Eigen::Matrix<Real, 4, 4> penalty_;  // of a face
  std::vector<Element, Eigen::aligned_allocator<Element>> cuts_;  // one per cut cell
  Vector diagonal_;
};

extern template class GridOperator<double>;
extern template class GridOperator<float>;
extern template GridOperator<float>::GridOperator(const GridOperator<double>&, double);

}  // namespace knotlight
