// An object on a grid of cubic cells that need not follow its surface: which cells lie inside,
// which part of the others does, and how much surface is in them. Depends on the shape and the cell
// size only; channels and right-hand sides share it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/shape.h"
#include "grid/cell_sampling.h"
#include "grid/level.h"

namespace knotlight {

// A point seen by the grid.
struct Place {
  std::int32_t piece = -1;    // -1: not near the object
  Vec3 local = Vec3::Zero();  // in the piece's cell; a little outside 0..1 if the point's own cell
                              // holds nothing of the object
};

// How far under the surface, in cells, a surface point is looked up: far enough to be on the right
// side of a gap, near enough to be in the same part.
inline constexpr double step_inside = 0.2;

struct GridQuality {
  std::size_t cells = 0;             // with a part of the object
  std::size_t cut_cells = 0;         // with surface
  double volume_error = 0.0;         // of the sum over cells, relative
  double area_error = 0.0;           // surface that found no cell, relative
  double thin_share = 0.0;           // of the surface: no whole cell among the 27 around it
  std::size_t unsure_lines = 0;      // see ScanLines
  double mean_chord_in_cells = 0.0;  // 4 V / (S h)
};

class GridGeometry {
 public:
  // h > 0: cell size, length. Work grows as (size / h)^2 for the cuts and (size / h)^3 for the
  // numbering. The shape must be closed and oriented outward. More than 2^30 cells in the bounding
  // box, or a shape without volume, gives ok() false.
  GridGeometry(const Shape& shape, double h, const Workers& workers);

  // Whether there is something to solve on.
  bool ok() const { return failure_.empty(); }
  const std::string& failure() const { return failure_; }
  // Whether cells are small enough for the shape; otherwise why not. Says nothing about the
  // medium: for that see cell_size.h.
  bool resolved() const { return ok() && unresolved_.empty(); }
  const std::string& unresolved() const { return ok() ? unresolved_ : failure_; }
  const GridQuality& quality() const { return quality_; }

  double h() const { return levels_.front().grid.h; }
  const Level& finest() const { return levels_.front(); }
  // Finest first, each of twice the cell size of the one before.
  const std::vector<Level>& levels() const { return levels_; }

  // Whether the second level can stand for a grid of its own: there is one, and it does not join
  // what a gap divides.
  bool has_nested_coarse() const;
  // Where a point inside or on the surface is. Across a gap narrower than a cell the side is found
  // by the nearest scan line; a surface point should be given with its outward normal, which tells
  // the sides apart.
  Place locate(const Vec3& x) const;
  Place locate(const Vec3& x, const Vec3& normal) const;

 private:
  friend class GeometryBuilder;

  // The piece at local coordinates of a cell; -1 if it holds nothing of the object.
  std::int32_t piece_at(std::int32_t cell, const Vec3& local) const;
  Place locate_in_cells(const Vec3& cell_units, const Vec3& within) const;

  std::vector<Level> levels_;
  std::vector<std::pair<std::int32_t, CellSample>> splits_;  // cells that a gap may divide, by cell
  GridQuality quality_;
  std::string failure_;
  std::string unresolved_;
};

}  // namespace knotlight
