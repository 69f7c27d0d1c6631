#include "grid/pattern.h"

#include <algorithm>

namespace knotlight {
namespace {

// Faces are penalised if a cell beside them is filled less than this: fuller ones are held well
// enough by their own stiffness, and every penalty costs a little accuracy.
constexpr double hardly_filled = 0.5;

// The 2 x 2 cells around an edge along x at one place on it, if whole and numbered as runs want:
// the unknowns of the 3 x 3 nodes at the lower end; those at the upper end are one more.
struct Column {
  bool regular = false;
  std::array<std::int32_t, 9> lower{};
};

Column column_at(const Level& level, int i, int j, int k) {
  Column column;
  for (int c = 0; c < 4; ++c) {
    const int cy = c & 1, cz = c >> 1;
    const std::int32_t piece =
        level.first_piece[static_cast<std::size_t>(level.grid.index(i, j - 1 + cy, k - 1 + cz))];
    if (piece < 0 || !level.whole(piece)) return column;
    const auto& dof = level.pieces[static_cast<std::size_t>(piece)].dof;
    for (int corner = 0; corner < 8; corner += 2) {
      const auto at = static_cast<std::size_t>(corner);
      if (dof[at] + 1 != dof[at + 1]) return column;
      const int y = cy + (corner >> 1 & 1), z = cz + (corner >> 2), row = y + 3 * z;
      column.lower[static_cast<std::size_t>(row)] = dof[at];
    }
  }
  column.regular = true;
  return column;
}

std::vector<GridPattern::Run> find_runs(const Level& level) {
  std::vector<GridPattern::Run> runs;
  const auto& n = level.grid.n;
  for (int k = 1; k < n[2]; ++k)
    for (int j = 1; j < n[1]; ++j) {
      bool running = false, before = false;
      for (int i = 0; i < n[0]; ++i) {
        const Column column = column_at(level, i, j, k);
        if (!column.regular || !before)
          running = false;
        else if (running)
          ++runs.back().count;
        else {
          runs.push_back({column.lower[4], 1, column.lower});
          running = true;
        }
        before = column.regular;
      }
    }
  return runs;
}

std::vector<GridPattern::Face> find_faces(const Level& level) {
  std::vector<GridPattern::Face> faces;
  std::vector<double> filled(level.cuts.size());
  for (std::size_t c = 0; c < filled.size(); ++c) filled[c] = total(level.cuts[c].volume);
  const auto filling = [&](std::int32_t piece) {
    const std::int32_t cut = level.pieces[static_cast<std::size_t>(piece)].cut;
    return cut < 0 ? 1.0 : filled[static_cast<std::size_t>(cut)];
  };
  // Corners of a face in its plane, of the lower cell's lower and upper side.
  constexpr std::array<std::array<int, 2>, 3> in_plane{{{2, 4}, {4, 1}, {1, 2}}};
  for (const CutPiece& cut : level.cuts) {
    const auto p = level.grid.position(level.pieces[static_cast<std::size_t>(cut.piece)].cell);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        auto q = p;
        q[static_cast<std::size_t>(axis)] += side;
        const auto [first, last] = level.pieces_of(q[0], q[1], q[2]);
        for (std::int32_t other = first; other < last; ++other) {
          // A face between two cut pieces is taken from the lower one.
          if (side < 0 && !level.whole(other)) continue;
          if (!(std::min(filling(cut.piece), filling(other)) < hardly_filled)) continue;
          const std::int32_t lower = side < 0 ? other : cut.piece;
          const std::int32_t upper = side < 0 ? cut.piece : other;
          if (!connected(level, lower, upper, axis)) continue;
          const auto& a = level.pieces[static_cast<std::size_t>(lower)].dof;
          const auto& b = level.pieces[static_cast<std::size_t>(upper)].dof;
          GridPattern::Face face;
          for (std::size_t c = 0; c < 4; ++c) {
            const auto& plane = in_plane[static_cast<std::size_t>(axis)];
            const auto low_corner = ((c & 1) ? plane[0] : 0) + ((c & 2) ? plane[1] : 0);
            const auto low = static_cast<std::size_t>(low_corner);
            const std::size_t high = low + (std::size_t{1} << axis);
            face[0][c] = a[low];
            face[1][c] = a[high];
            face[2][c] = b[high];
          }
          faces.push_back(face);
        }
      }
  }
  return faces;
}

}  // namespace

GridPattern::GridPattern(const Level& level)
    : unknowns(level.dofs), runs(find_runs(level)), faces(find_faces(level)) {
  std::vector<std::uint8_t> in_run(static_cast<std::size_t>(level.dofs), 0);
  for (const Run& run : runs) std::fill_n(in_run.begin() + run.first, run.count, std::uint8_t{1});
  for (std::int32_t i = 0; i < level.dofs; ++i)
    if (in_run[static_cast<std::size_t>(i)] == 0) others.push_back(i);
  cut_cells.reserve(level.cuts.size());
  for (const CutPiece& cut : level.cuts)
    cut_cells.push_back(level.pieces[static_cast<std::size_t>(cut.piece)].dof);
  for (const Piece& piece : level.pieces)
    if (piece.cut < 0 && std::any_of(piece.dof.begin(), piece.dof.end(), [&](std::int32_t dof) {
          return in_run[static_cast<std::size_t>(dof)] == 0;
        }))
      whole_cells.push_back(piece.dof);
}

}  // namespace knotlight
