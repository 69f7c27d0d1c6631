// A regular grid of boxes to count light in, and the way of a straight flight through it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/mesh.h"

namespace knotlight {

// n[0] x n[1] x n[2] equal cells between lo and hi; x runs fastest in the cell's number. A point on
// the border of two cells belongs to the upper one. Bins across a slab and probe cells along a line
// are grids with n = 1 in the other directions.
struct FluxGrid {
  Vec3 lo = Vec3::Zero();
  Vec3 hi = Vec3::Ones();
  std::array<int, 3> n{1, 1, 1};

  std::size_t cells() const { return static_cast<std::size_t>(n[0]) * n[1] * n[2]; }
  std::size_t number(const std::array<int, 3>& i) const {
    return (static_cast<std::size_t>(i[2]) * n[1] + i[1]) * n[0] + i[0];
  }
  // Edges of a cell, length.
  Vec3 cell_size() const {
    return (hi - lo).array() / Eigen::Array3d(static_cast<double>(n[0]), static_cast<double>(n[1]),
                                              static_cast<double>(n[2]));
  }
  // Coordinate of the border below index i on an axis; the same value from either side.
  double border(int axis, int i) const { return lo[axis] + (hi[axis] - lo[axis]) * i / n[axis]; }
  Bounds cell_bounds(std::size_t number) const;
  // Nothing if p is not in the grid.
  std::optional<std::size_t> cell_at(const Vec3& p) const;

  // Calls visit(cell, length) for every cell that the flight from `start` along the unit vector
  // `direction` crosses, in order: a walk from border to border [AW87].
  template <class Visit>
  void along(const Vec3& start, const Vec3& direction, double flight, Visit visit) const;
};

template <class Visit>
void FluxGrid::along(const Vec3& start, const Vec3& direction, double flight, Visit visit) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  double t = 0.0;
  double end = flight;
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) {
      if (start[a] < lo[a] || start[a] >= hi[a]) return;
      continue;
    }
    const double to_lo = (lo[a] - start[a]) / direction[a];
    const double to_hi = (hi[a] - start[a]) / direction[a];
    t = std::max(t, std::min(to_lo, to_hi));
    end = std::min(end, std::max(to_lo, to_hi));
  }
  if (!(t < end)) return;

  std::array<int, 3> cell{};
  std::array<double, 3> leave{};  // where the flight leaves this cell through each axis
  const auto leaves_at = [&](int a, int i) {
    if (direction[a] == 0.0) return never;
    return (border(a, direction[a] > 0.0 ? i + 1 : i) - start[a]) / direction[a];
  };
  for (int a = 0; a < 3; ++a) {
    const double x = (start[a] + t * direction[a] - lo[a]) / (hi[a] - lo[a]) * n[a];
    cell[a] = std::clamp(static_cast<int>(std::floor(x)), 0, n[a] - 1);
    leave[a] = leaves_at(a, cell[a]);
  }
  while (true) {
    const int a = static_cast<int>(std::min_element(leave.begin(), leave.end()) - leave.begin());
    const double next = std::min(leave[a], end);
    if (next > t) {
      visit(number(cell), next - t);
      t = next;
    }
    if (leave[a] >= end) return;
    cell[a] += direction[a] > 0.0 ? 1 : -1;
    if (cell[a] < 0 || cell[a] >= n[a]) return;
    leave[a] = leaves_at(a, cell[a]);
  }
}

}  // namespace knotlight
