#include "grid/operator.h"

#include <bit>
#include <cassert>
#include <optional>

namespace knotlight {
namespace {

// Faces are penalised if a cell beside them is filled less than this: fuller ones are held well
// enough by their own stiffness, and every penalty costs a little accuracy.
constexpr double hardly_filled = 0.5;

// int over the unit square of products of bilinear shape functions.
const Eigen::Matrix4d& square_mass() {
  static const Eigen::Matrix4d mass = [] {
    Eigen::Matrix4d m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m(i, j) = 4.0 / 36.0 / (1 << std::popcount(unsigned(i ^ j)));
    return m;
  }();
  return mass;
}

}  // namespace

GridOperator::GridOperator(const Level& level, const OperatorCoefficients& coefficients,
                           double fineness)
    : level_(level) {
  assert(coefficients.lambda >= 0.0 && coefficients.k > 0.0);
  const double h = level.grid.h;
  const Moments cell = full_cell_moments();
  whole_ = h * stiffness_matrix(cell) +
           coefficients.lambda * coefficients.lambda * h * h * h * mass_matrix(cell);
  // A neighbour that differs along m axes shares 8 / 2^m cells.
  stencil_ = {8.0 * whole_(0, 0), 4.0 * whole_(0, 1), 2.0 * whole_(0, 3), whole_(0, 7)};
  penalty_ = coefficients.penalty * h / fineness;
  find_runs();
  find_elements(coefficients);
  find_faces();
  find_diagonal();
}

void GridOperator::find_runs() {
  in_run_.assign(static_cast<std::size_t>(level_.dofs), 0);
  const auto& n = level_.grid.n;
  // Unknowns of the 3 x 3 rows around a node, if the pattern is that of whole cells.
  const auto rows_around = [&](int i, int j, int k) -> std::optional<std::array<std::int32_t, 9>> {
    std::array<std::int32_t, 8> pieces;
    for (int c = 0; c < 8; ++c) {
      const auto o = corner_offset(c);
      pieces[static_cast<std::size_t>(c)] = level_.first_piece[static_cast<std::size_t>(
          level_.grid.index(i - 1 + o[0], j - 1 + o[1], k - 1 + o[2]))];
      if (pieces[static_cast<std::size_t>(c)] < 0 ||
          !level_.whole(pieces[static_cast<std::size_t>(c)]))
        return std::nullopt;
    }
    const auto dof = [&](int dx, int dy, int dz) {
      const int cx = dx > 0, cy = dy > 0, cz = dz > 0;
      const int corner = dx + 1 - cx + 2 * (dy + 1 - cy) + 4 * (dz + 1 - cz);
      const int cell = cx + 2 * cy + 4 * cz;
      const auto piece = static_cast<std::size_t>(pieces[static_cast<std::size_t>(cell)]);
      return level_.pieces[piece].dof[static_cast<std::size_t>(corner)];
    };
    std::array<std::int32_t, 9> rows;
    for (int r = 0; r < 9; ++r) {
      const int dy = r % 3 - 1, dz = r / 3 - 1;
      rows[static_cast<std::size_t>(r)] = dof(0, dy, dz);
      if (dof(-1, dy, dz) + 1 != dof(0, dy, dz) || dof(0, dy, dz) + 1 != dof(1, dy, dz))
        return std::nullopt;
    }
    return rows;
  };
  for (int k = 1; k < n[2]; ++k)
    for (int j = 1; j < n[1]; ++j) {
      bool running = false;
      for (int i = 1; i < n[0]; ++i) {
        const auto rows = rows_around(i, j, k);
        if (!rows) {
          running = false;
          continue;
        }
        const std::int32_t dof = (*rows)[4];
        in_run_[static_cast<std::size_t>(dof)] = 1;
        if (running)
          ++runs_.back().count;
        else
          runs_.push_back({dof, 1, *rows});
        running = true;
      }
    }
}

void GridOperator::find_elements(const OperatorCoefficients& coefficients) {
  const double h = level_.grid.h, lambda = coefficients.lambda;
  for (std::size_t p = 0; p < level_.pieces.size(); ++p) {
    const Piece& piece = level_.pieces[p];
    bool needed = piece.cut >= 0;
    for (const std::int32_t dof : piece.dof)
      needed = needed || in_run_[static_cast<std::size_t>(dof)] == 0;
    if (!needed) continue;
    Element element{static_cast<std::int32_t>(p), -1};
    if (piece.cut >= 0) {
      const CutPiece& cut = level_.cuts[static_cast<std::size_t>(piece.cut)];
      element.matrix = static_cast<std::int32_t>(matrices_.size());
      matrices_.push_back(h * stiffness_matrix(cut.volume) +
                          lambda * lambda * h * h * h * mass_matrix(cut.volume) +
                          h * h / coefficients.k * mass_matrix(cut.surface));
    }
    elements_.push_back(element);
  }
}

void GridOperator::find_faces() {
  std::vector<double> filled(level_.cuts.size());
  for (std::size_t c = 0; c < filled.size(); ++c) filled[c] = total(level_.cuts[c].volume);
  const auto filling = [&](std::int32_t piece) {
    const std::int32_t cut = level_.pieces[static_cast<std::size_t>(piece)].cut;
    return cut < 0 ? 1.0 : filled[static_cast<std::size_t>(cut)];
  };
  // Corners of a face in its plane, of the lower cell's lower and upper side.
  constexpr std::array<std::array<int, 2>, 3> in_plane{{{2, 4}, {4, 1}, {1, 2}}};
  for (const CutPiece& cut : level_.cuts) {
    const auto p = level_.grid.position(level_.pieces[static_cast<std::size_t>(cut.piece)].cell);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        auto q = p;
        q[static_cast<std::size_t>(axis)] += side;
        const auto [first, last] = level_.pieces_of(q[0], q[1], q[2]);
        for (std::int32_t other = first; other < last; ++other) {
          // A face between two cut pieces is taken from the lower one.
          if (side < 0 && !level_.whole(other)) continue;
          if (!(std::min(filling(cut.piece), filling(other)) < hardly_filled)) continue;
          const std::int32_t lower = side < 0 ? other : cut.piece;
          const std::int32_t upper = side < 0 ? cut.piece : other;
          if (!connected(level_, lower, upper, axis)) continue;
          const auto& a = level_.pieces[static_cast<std::size_t>(lower)].dof;
          const auto& b = level_.pieces[static_cast<std::size_t>(upper)].dof;
          Face face;
          for (std::size_t c = 0; c < 4; ++c) {
            const auto& plane = in_plane[static_cast<std::size_t>(axis)];
            const auto low_corner = ((c & 1) ? plane[0] : 0) + ((c & 2) ? plane[1] : 0);
            const auto low = static_cast<std::size_t>(low_corner);
            const std::size_t high = low + (std::size_t{1} << axis);
            face.dof[0][c] = a[low];
            face.dof[1][c] = a[high];
            face.dof[2][c] = b[high];
          }
          faces_.push_back(face);
        }
      }
  }
}

// Sums of the four rows beside and the four rows across an edge are shared by three neighbours.
void GridOperator::apply_runs(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  std::vector<double> beside_row, across_row;
  for (const Run& run : runs_) {
    const auto length = static_cast<std::size_t>(run.count) + 2;
    if (beside_row.size() < length) {
      beside_row.resize(length);
      across_row.resize(length);
    }
    std::array<const double*, 9> row;
    for (std::size_t r = 0; r < 9; ++r) row[r] = x.data() + run.rows[r] - 1;
    double* const beside = beside_row.data();
    double* const across = across_row.data();
    for (std::size_t i = 0; i < length; ++i) {
      beside[i] = (row[1][i] + row[3][i]) + (row[5][i] + row[7][i]);
      across[i] = (row[0][i] + row[2][i]) + (row[6][i] + row[8][i]);
    }
    const double* const own = row[4];
    double* const out = y.data() + run.first;
    for (std::size_t i = 0; i + 2 < length; ++i)
      out[i] = stencil_[0] * own[i + 1] + stencil_[1] * (own[i] + own[i + 2] + beside[i + 1]) +
               stencil_[2] * (beside[i] + beside[i + 2] + across[i + 1]) +
               stencil_[3] * (across[i] + across[i + 2]);
  }
}

void GridOperator::apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.setZero(level_.dofs);
  apply_runs(x, y);
  ElementVector in, out;
  for (const Element& element : elements_) {
    const auto& dof = level_.pieces[static_cast<std::size_t>(element.piece)].dof;
    for (std::size_t c = 0; c < 8; ++c) in[static_cast<int>(c)] = x[dof[c]];
    if (element.matrix >= 0) {
      out.noalias() = matrices_[static_cast<std::size_t>(element.matrix)].lazyProduct(in);
      for (std::size_t c = 0; c < 8; ++c) y[dof[c]] += out[static_cast<int>(c)];
    } else {
      out.noalias() = whole_.lazyProduct(in);
      for (std::size_t c = 0; c < 8; ++c)
        if (in_run_[static_cast<std::size_t>(dof[c])] == 0) y[dof[c]] += out[static_cast<int>(c)];
    }
  }
  // The jump of the normal derivative, times h, is the second difference across the face.
  const Eigen::Matrix4d mass = penalty_ * square_mass();
  for (const Face& face : faces_) {
    Eigen::Vector4d jump;
    for (std::size_t c = 0; c < 4; ++c)
      jump[static_cast<int>(c)] = x[face.dof[0][c]] - 2.0 * x[face.dof[1][c]] + x[face.dof[2][c]];
    const Eigen::Vector4d pull = mass * jump;
    for (std::size_t c = 0; c < 4; ++c) {
      const double p = pull[static_cast<int>(c)];
      y[face.dof[0][c]] += p;
      y[face.dof[1][c]] -= 2.0 * p;
      y[face.dof[2][c]] += p;
    }
  }
}

void GridOperator::find_diagonal() {
  diagonal_ = Eigen::VectorXd::Zero(level_.dofs);
  for (std::size_t i = 0; i < in_run_.size(); ++i)
    if (in_run_[i] != 0) diagonal_[static_cast<Eigen::Index>(i)] = stencil_[0];
  for (const Element& element : elements_) {
    const auto& dof = level_.pieces[static_cast<std::size_t>(element.piece)].dof;
    const ElementMatrix& m =
        element.matrix >= 0 ? matrices_[static_cast<std::size_t>(element.matrix)] : whole_;
    for (std::size_t c = 0; c < 8; ++c)
      if (element.matrix >= 0 || in_run_[static_cast<std::size_t>(dof[c])] == 0)
        diagonal_[dof[c]] += m(static_cast<int>(c), static_cast<int>(c));
  }
  const double own = penalty_ * square_mass()(0, 0);
  for (const Face& face : faces_)
    for (std::size_t c = 0; c < 4; ++c) {
      diagonal_[face.dof[0][c]] += own;
      diagonal_[face.dof[1][c]] += 4.0 * own;
      diagonal_[face.dof[2][c]] += own;
    }
}

}  // namespace knotlight
