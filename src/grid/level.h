// The object on one grid: its pieces (a cell, or one connected part of a cell that a gap divides),
// their moments, and the numbering of the unknowns at the grid's nodes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/cell_grid.h"
#include "grid/moments.h"

namespace knotlight {

// A cell is sampled by 4 x 4 x 4 places; bit x + 4 y + 16 z.
using Places = std::uint64_t;
inline constexpr Places all_places = ~Places{0};

struct Piece {
  std::int32_t cell = -1;
  std::int32_t cut = -1;              // index of its CutPiece; -1: a whole cell
  std::array<std::int32_t, 8> dof{};  // unknown at each corner
};

// What a piece needs beyond a whole cell.
struct CutPiece {
  std::int32_t piece = -1;
  Moments volume{};   // in cell volumes
  Moments surface{};  // in cell faces
  Places inside = 0;
  // Bit per face (2 axis + upper): taken as connected there although no line shows it. For pieces
  // that the sampling does not see connected to anything.
  std::uint8_t loose = 0;
  // Per face (2 axis + upper): of the 4 x 4 lines through it, those that stay inside the object
  // from the last place on one side to the first on the other.
  std::array<std::uint16_t, 6> links{};
};

struct Level {
  CellGrid grid;
  std::vector<std::int32_t> first_piece;  // per cell; -1: outside. A cell's pieces are consecutive.
  std::vector<Piece> pieces;              // by cell
  std::vector<CutPiece> cuts;
  std::int32_t dofs = 0;
  // Cells in which coarser() has put together what faces between its children keep apart.
  std::size_t joined_cells = 0;

  bool whole(std::int32_t piece) const { return pieces[static_cast<std::size_t>(piece)].cut < 0; }
  const CutPiece& cut(std::int32_t piece) const {
    return cuts[static_cast<std::size_t>(pieces[static_cast<std::size_t>(piece)].cut)];
  }
  // The pieces of a cell as a range [first, last); empty outside the grid.
  std::pair<std::int32_t, std::int32_t> pieces_of(int i, int j, int k) const;
};

// Whether a path inside the object leads from piece `lower` to piece `upper` of the next cell along
// the axis through their common face.
bool connected(const Level& level, std::int32_t lower, std::int32_t upper, int axis);

// Numbers the unknowns, x fastest. Pieces around a node share its unknown if they are connected
// through faces at that node; others get unknowns of their own, numbered after all first ones, so
// that nothing flows across a gap.
void number_unknowns(Level& level);

// The grid of twice the cell size, moments added up: the same integrals to rounding. Gaps are not
// kept, which is good enough for a preconditioner.
Level coarser(const Level& fine);

// int N_i over the volume (length^3) and over the surface (length^2), per unknown.
struct NodeWeights {
  Eigen::VectorXd volume, surface;
};
NodeWeights node_weights(const Level& level);

}  // namespace knotlight
