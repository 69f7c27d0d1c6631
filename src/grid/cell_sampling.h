// One cell that holds surface, sampled by the scan lines of the three axes.
#pragma once

#include <array>
#include <vector>

#include "grid/level.h"
#include "grid/scan_lines.h"

namespace knotlight {

using AxisLines = std::array<ScanLines, 3>;

// Part of a line inside the object, along the axis in the cell's coordinates, within 0..1.
struct LinePart {
  double begin = 0.0, end = 0.0;
  std::int32_t piece = -1;  // filled in when pieces are known
};

struct CellSample {
  Places inside = 0;                     // places that lie inside the object
  std::array<std::uint16_t, 6> links{};  // see CutPiece
  std::vector<Places> parts;             // connected sets of places within the cell
  // The 16 lines along `axis`, the one that the surface faces most: along it the volume is exact
  // where each line meets the surface, whatever the depth.
  int axis = 0;
  std::array<std::vector<LinePart>, 16> lines;

  // Whether a gap may divide the cell.
  bool split() const;
};

// facing: sum of area |n| over the surface in the cell. What `sample` held before is lost, but not
// its memory.
void sample_cell(const AxisLines& lines, const std::array<int, 3>& cell, const Vec3& facing,
                 CellSample& sample);

// Quadrature over one line part: adds it to the moments of the cell with `shift` subtracted from
// the local coordinates (for a part that is counted with the next cell). Sums over a whole cell are
// exact for its moments.
void add_line_part(Moments& moments, int axis, int line, const LinePart& part, const Vec3& shift);

// The bit of the place `layer` places up along the axis on line 0..15 of it.
int place_bit(int axis, int layer, int line);

}  // namespace knotlight
