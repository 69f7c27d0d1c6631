#include "grid/operator.h"

#include <bit>
#include <cassert>

namespace knotlight {
namespace {

// int over the unit square of products of bilinear shape functions.
Eigen::Matrix4d square_mass() {
  Eigen::Matrix4d m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m(i, j) = 4.0 / 36.0 / (1 << std::popcount(unsigned(i ^ j)));
  return m;
}

}  // namespace

template <class Real>
GridOperator<Real>::GridOperator(const Level& level, const OperatorCoefficients& coefficients,
                                 double fineness)
    : pattern_(std::make_shared<const GridPattern>(level)) {
  const double lambda = coefficients.lambda, k = coefficients.k;
  assert(lambda >= 0.0 && k > 0.0);
  const double h = level.grid.h;
  const auto element = [&](const Moments& volume) -> ElementMatrix {
    return h * stiffness_matrix(volume) + lambda * lambda * h * h * h * mass_matrix(volume);
  };
  whole_ = element(full_cell_moments()).template cast<Real>();
  // A neighbour that differs along m axes shares 8 / 2^m cells.
  stencil_ = {8 * whole_(0, 0), 4 * whole_(0, 1), 2 * whole_(0, 3), whole_(0, 7)};
  // The jump of the normal derivative, times h, is the second difference across the face.
  penalty_ = (coefficients.penalty * h / fineness * square_mass()).template cast<Real>();
  cuts_.reserve(level.cuts.size());
  for (const CutPiece& cut : level.cuts)
    cuts_.emplace_back(
        (element(cut.volume) + h * h / k * mass_matrix(cut.surface)).template cast<Real>());
  find_diagonal();
}

template <class Real>
template <class Other>
GridOperator<Real>::GridOperator(const GridOperator<Other>& other, double scale)
    : pattern_(other.pattern_) {
  const auto scaled = [scale](const auto& m) { return (scale * m).template cast<Real>(); };
  whole_ = scaled(other.whole_);
  for (std::size_t i = 0; i < stencil_.size(); ++i)
    stencil_[i] = static_cast<Real>(scale * other.stencil_[i]);
  penalty_ = scaled(other.penalty_);
  cuts_.reserve(other.cuts_.size());
  for (const auto& cut : other.cuts_) cuts_.emplace_back(scaled(cut));
  diagonal_ = scaled(other.diagonal_);
}

// Sums of the four rows beside and the four rows across an edge are shared by three neighbours.
template <class Real>
void GridOperator<Real>::apply_runs(const Vector& x, Vector& y) const {
  std::vector<Real> beside_row, across_row;
  for (const GridPattern::Run& run : pattern_->runs) {
    const auto length = static_cast<std::size_t>(run.count) + 2;
    if (beside_row.size() < length) {
      beside_row.resize(length);
      across_row.resize(length);
    }
    std::array<const Real*, 9> row;
    for (std::size_t r = 0; r < 9; ++r) row[r] = x.data() + run.rows[r] - 1;
    Real* const beside = beside_row.data();
    Real* const across = across_row.data();
    for (std::size_t i = 0; i < length; ++i) {
      beside[i] = (row[1][i] + row[3][i]) + (row[5][i] + row[7][i]);
      across[i] = (row[0][i] + row[2][i]) + (row[6][i] + row[8][i]);
    }
    const Real* const own = row[4];
    Real* const out = y.data() + run.first;
    for (std::size_t i = 0; i + 2 < length; ++i)
      out[i] = stencil_[0] * own[i + 1] + stencil_[1] * (own[i] + own[i + 2] + beside[i + 1]) +
               stencil_[2] * (beside[i] + beside[i + 2] + across[i + 1]) +
               stencil_[3] * (across[i] + across[i + 2]);
  }
}

template <class Real>
void GridOperator<Real>::apply(const Vector& x, Vector& y) const {
  using Corner = Eigen::Matrix<Real, 8, 1>;
  const auto add_element = [&](const GridPattern::Corners& dof, const Element& matrix) {
    Corner in;
    for (std::size_t c = 0; c < 8; ++c) in[static_cast<int>(c)] = x[dof[c]];
    const Corner out = matrix.lazyProduct(in);
    for (std::size_t c = 0; c < 8; ++c) y[dof[c]] += out[static_cast<int>(c)];
  };
  if (y.size() != x.size()) y.setZero(x.size());
  for (const std::int32_t i : pattern_->others) y[i] = 0;
  // What whole cells add to unknowns in runs is overwritten by the runs, which count all cells.
  for (const GridPattern::Corners& cell : pattern_->whole_cells) add_element(cell, whole_);
  apply_runs(x, y);
  for (std::size_t c = 0; c < cuts_.size(); ++c) add_element(pattern_->cut_cells[c], cuts_[c]);
  for (const GridPattern::Face& face : pattern_->faces) {
    Eigen::Matrix<Real, 4, 1> jump;
    for (std::size_t c = 0; c < 4; ++c)
      jump[static_cast<int>(c)] = x[face[0][c]] - 2 * x[face[1][c]] + x[face[2][c]];
    const Eigen::Matrix<Real, 4, 1> pull = penalty_.lazyProduct(jump);
    for (std::size_t c = 0; c < 4; ++c) {
      const Real p = pull[static_cast<int>(c)];
      y[face[0][c]] += p;
      y[face[1][c]] -= 2 * p;
      y[face[2][c]] += p;
    }
  }
}

template <class Real>
void GridOperator<Real>::find_diagonal() {
  diagonal_ = Vector::Zero(size());
  for (const GridPattern::Corners& cell : pattern_->whole_cells)
    for (std::size_t c = 0; c < 8; ++c) diagonal_[cell[c]] += whole_(0, 0);
  for (const GridPattern::Run& run : pattern_->runs)
    diagonal_.segment(run.first, run.count).setConstant(stencil_[0]);
  for (std::size_t cut = 0; cut < cuts_.size(); ++cut)
    for (std::size_t c = 0; c < 8; ++c)
      diagonal_[pattern_->cut_cells[cut][c]] +=
          cuts_[cut](static_cast<int>(c), static_cast<int>(c));
  const Real own = penalty_(0, 0);
  for (const GridPattern::Face& face : pattern_->faces)
    for (std::size_t c = 0; c < 4; ++c) {
      diagonal_[face[0][c]] += own;
      diagonal_[face[1][c]] += 4 * own;
      diagonal_[face[2][c]] += own;
    }
}

template class GridOperator<double>;
template class GridOperator<float>;
template GridOperator<float>::GridOperator(const GridOperator<double>&, double);

}  // namespace knotlight
