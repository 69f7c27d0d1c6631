// Which parts of the lines parallel to an axis lie inside a closed mesh: scan conversion. Exact up
// to rounding, so that a gap between two parts is seen however narrow it is.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh.h"

namespace knotlight {

// Lines per cell edge: a cell is crossed by 4 x 4 lines of each axis.
inline constexpr int lines_per_cell = 4;

struct Interval {
  double begin, end;
};

// The lines along one axis a. With b = (a+1)%3, c = (a+2)%3, line (i, j) runs through
// b = (i + 1/2) / 4, c = (j + 1/2) / 4 in cell units.
class ScanLines {
 public:
  // `mesh` in cell units (cells are unit cubes from 0); n = cells per axis. Inside is where the
  // winding number is positive. A line whose crossings do not cancel, because the mesh has a hole
  // or the line meets an edge to rounding, takes the intervals of the line before it and is
  // counted.
  ScanLines(const TriangleMesh& mesh, const std::array<int, 3>& n, int axis);

  int axis() const { return axis_; }
  // Inside parts, increasing and disjoint, in cell units.
  std::span<const Interval> line(int i, int j) const {
    const std::size_t at = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(i);
    return {intervals_.data() + first_[at], intervals_.data() + first_[at + 1]};
  }
  std::size_t lines() const { return first_.size() - 1; }
  std::size_t unsure_lines() const { return unsure_; }

 private:
  int axis_;
  int columns_;
  std::vector<std::size_t> first_;  // lines + 1
  std::vector<Interval> intervals_;
  std::size_t unsure_ = 0;
};

}  // namespace knotlight
