// A box of cubic cells, and the corner numbering that every file here shares: corner c of a cell
// has the offsets (c & 1, c >> 1 & 1, c >> 2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/vec3.h"

namespace knotlight {

struct CellGrid {
  Vec3 origin = Vec3::Zero();
  double h = 1.0;                 // edge of a cell, length
  std::array<int, 3> n{0, 0, 0};  // cells along x, y, z

  std::size_t cells() const { return static_cast<std::size_t>(n[0]) * n[1] * n[2]; }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < n[0] && j < n[1] && k < n[2];
  }
  std::int32_t index(int i, int j, int k) const {
    return static_cast<std::int32_t>((static_cast<std::int64_t>(k) * n[1] + j) * n[0] + i);
  }
  std::array<int, 3> position(std::int32_t cell) const {
    return {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
  }
  // Coordinates in which cells are unit cubes and cell (0, 0, 0) starts at 0.
  Vec3 to_cells(const Vec3& x) const { return (x - origin) / h; }
};

inline constexpr std::array<int, 3> corner_offset(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2};
}

}  // namespace knotlight
