#include "grid/level.h"

#include <algorithm>

#include "grid/cell_sampling.h"

namespace knotlight {
namespace {

// A piece at a node: which of the 8 cells around it, counted as a corner, holds it.
struct Around {
  std::int32_t piece;
  int cell_corner;
  int group;
};

// Pieces around one node, in groups that are connected through faces at the node.
void group_pieces(const Level& level, std::vector<Around>& around) {
  for (std::size_t a = 0; a < around.size(); ++a) around[a].group = static_cast<int>(a);
  for (const Around& lower : around)
    for (const Around& upper : around) {
      const int step = lower.cell_corner ^ upper.cell_corner;
      if (lower.cell_corner > upper.cell_corner || (step != 1 && step != 2 && step != 4)) continue;
      if (lower.group == upper.group) continue;
      if (!connected(level, lower.piece, upper.piece, step >> 1)) continue;
      const int from = std::max(lower.group, upper.group), to = std::min(lower.group, upper.group);
      for (Around& other : around)
        if (other.group == from) other.group = to;
    }
}

}  // namespace

std::pair<std::int32_t, std::int32_t> Level::pieces_of(int i, int j, int k) const {
  if (!grid.contains(i, j, k)) return {0, 0};
  const std::int32_t cell = grid.index(i, j, k);
  const std::int32_t first = first_piece[static_cast<std::size_t>(cell)];
  if (first < 0) return {0, 0};
  std::int32_t last = first + 1;
  while (static_cast<std::size_t>(last) < pieces.size() &&
         pieces[static_cast<std::size_t>(last)].cell == cell)
    ++last;
  return {first, last};
}

bool connected(const Level& level, std::int32_t lower, std::int32_t upper, int axis) {
  const bool whole_lower = level.whole(lower), whole_upper = level.whole(upper);
  if (whole_lower && whole_upper) return true;
  const std::size_t face = 2 * static_cast<std::size_t>(axis);
  if ((!whole_lower && (level.cut(lower).loose >> (face + 1) & 1) != 0) ||
      (!whole_upper && (level.cut(upper).loose >> face & 1) != 0))
    return true;
  const Places below = whole_lower ? all_places : level.cut(lower).inside;
  const Places above = whole_upper ? all_places : level.cut(upper).inside;
  const unsigned links =
      whole_lower ? level.cut(upper).links[face] : level.cut(lower).links[face + 1];
  for (int line = 0; line < 16; ++line)
    if ((links >> line & 1U) != 0 && (below >> place_bit(axis, 3, line) & 1) != 0 &&
        (above >> place_bit(axis, 0, line) & 1) != 0)
      return true;
  return false;
}

void number_unknowns(Level& level) {
  struct Later {
    std::int32_t piece;
    int corner;
    bool starts;  // a new unknown
  };
  std::vector<Later> later;
  std::vector<Around> around;
  std::int32_t next = 0;
  const auto& n = level.grid.n;
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) {
        around.clear();
        bool plain = true;
        for (int c = 0; c < 8; ++c) {
          const auto o = corner_offset(c);
          const auto [first, last] = level.pieces_of(i - 1 + o[0], j - 1 + o[1], k - 1 + o[2]);
          for (std::int32_t p = first; p < last; ++p) around.push_back({p, c, 0});
          plain = plain && last == first + 1 && level.whole(first);
        }
        if (around.empty()) continue;
        if (!plain) {
          group_pieces(level, around);
          // The group of a whole cell comes first: runs of whole cells then have unknowns in a row.
          for (const Around& a : around)
            if (level.whole(a.piece)) {
              const int chosen = a.group;
              for (Around& b : around) b.group = b.group == chosen ? -1 : b.group;
              break;
            }
          std::stable_sort(around.begin(), around.end(),
                           [](const Around& a, const Around& b) { return a.group < b.group; });
        }
        const int primary = around.front().group;
        for (std::size_t a = 0; a < around.size(); ++a) {
          const int corner = 7 - around[a].cell_corner;  // the node seen from that cell
          if (around[a].group == primary)
            level.pieces[static_cast<std::size_t>(around[a].piece)]
                .dof[static_cast<std::size_t>(corner)] = next;
          else
            later.push_back({around[a].piece, corner, around[a].group != around[a - 1].group});
        }
        ++next;
      }
  for (const Later& l : later) {
    if (l.starts) ++next;
    level.pieces[static_cast<std::size_t>(l.piece)].dof[static_cast<std::size_t>(l.corner)] =
        next - 1;
  }
  level.dofs = next;
}

namespace {

// Whether the parts of the object in the children of one coarse cell hang together within it.
bool hangs_together(const Level& fine, std::vector<Around>& children) {
  group_pieces(fine, children);
  return std::all_of(children.begin(), children.end(),
                     [](const Around& child) { return child.group == 0; });
}

}  // namespace

Level coarser(const Level& fine) {
  Level coarse;
  coarse.grid.origin = fine.grid.origin;
  coarse.grid.h = 2.0 * fine.grid.h;
  for (std::size_t a = 0; a < 3; ++a) coarse.grid.n[a] = (fine.grid.n[a] + 1) / 2;
  coarse.first_piece.assign(coarse.grid.cells(), -1);
  const Moments whole = full_cell_moments();
  const auto& n = coarse.grid.n;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        int children = 0, whole_children = 0;
        CutPiece cut;
        const auto for_each_child = [&](const auto& visit) {
          for (int c = 0; c < 8; ++c) {
            const auto o = corner_offset(c);
            const auto [first, last] = fine.pieces_of(2 * i + o[0], 2 * j + o[1], 2 * k + o[2]);
            for (std::int32_t p = first; p < last; ++p) visit(c, p);
          }
        };
        for_each_child([&](int, std::int32_t p) {
          ++children;
          whole_children += fine.whole(p) ? 1 : 0;
        });
        if (children == 0) continue;
        Piece piece;
        piece.cell = coarse.grid.index(i, j, k);
        const auto index = static_cast<std::int32_t>(coarse.pieces.size());
        if (whole_children != 8) {
          std::vector<Around> inside;
          for_each_child([&](int c, std::int32_t p) { inside.push_back({p, c, 0}); });
          if (!hangs_together(fine, inside)) ++coarse.joined_cells;
          cut.piece = index;
          cut.loose = 0x3f;
          for_each_child([&](int c, std::int32_t p) {
            add_to_parent(cut.volume, fine.whole(p) ? whole : fine.cut(p).volume, c, 1.0 / 8.0);
            if (!fine.whole(p)) add_to_parent(cut.surface, fine.cut(p).surface, c, 1.0 / 4.0);
          });
          piece.cut = static_cast<std::int32_t>(coarse.cuts.size());
          coarse.cuts.push_back(cut);
        }
        coarse.first_piece[static_cast<std::size_t>(piece.cell)] = index;
        coarse.pieces.push_back(piece);
      }
  number_unknowns(coarse);
  return coarse;
}

NodeWeights node_weights(const Level& level) {
  const double h = level.grid.h;
  NodeWeights weights{Eigen::VectorXd::Zero(level.dofs), Eigen::VectorXd::Zero(level.dofs)};
  for (const Piece& piece : level.pieces) {
    // A node's weight is a row of the mass matrix added up: the shape functions add up to 1.
    ElementVector volume = ElementVector::Constant(0.125), surface = ElementVector::Zero();
    if (piece.cut >= 0) {
      const CutPiece& cut = level.cuts[static_cast<std::size_t>(piece.cut)];
      volume = mass_matrix(cut.volume).rowwise().sum();
      surface = mass_matrix(cut.surface).rowwise().sum();
    }
    for (int c = 0; c < 8; ++c) {
      const std::int32_t dof = piece.dof[static_cast<std::size_t>(c)];
      weights.volume[dof] += h * h * h * volume[c];
      weights.surface[dof] += h * h * surface[c];
    }
  }
  return weights;
}

}  // namespace knotlight
