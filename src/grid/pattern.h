// Which unknowns of a level meet in the matrix, whatever the medium: rows of whole cells, in which
// all rows of the matrix are alike, and cells and faces near the surface that are added one by one.
#pragma once

#include <vector>

#include "grid/level.h"

namespace knotlight {

struct GridPattern {
  explicit GridPattern(const Level& level);

  // Unknowns first .. first + count - 1 are neighbours along x with whole cells all around; row r =
  // (dy+1) + 3 (dz+1) of their neighbours starts at rows[r].
  struct Run {
    std::int32_t first, count;
    std::array<std::int32_t, 9> rows;
  };
  using Corners = std::array<std::int32_t, 8>;  // unknowns
  // Unknowns on the three planes x = -1, 0, 1 across a penalised face.
  using Face = std::array<std::array<std::int32_t, 4>, 3>;

  std::int32_t unknowns;
  std::vector<Run> runs;
  std::vector<std::int32_t> others;  // unknowns in no run, increasing
  std::vector<Corners> whole_cells;  // with an unknown in no run
  std::vector<Corners> cut_cells;    // one per cut of the level, in its order
  std::vector<Face> faces;           // beside cells that are hardly filled
};

}  // namespace knotlight
