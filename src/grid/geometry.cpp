#include "grid/geometry.h"

#include <algorithm>
#include <cmath>

#include "grid/geometry_builder.h"

namespace knotlight {
namespace {

// Shape functions may be carried this far out of their cell: the centre of a cell beside it.
constexpr double farthest_outside = 0.5;

}  // namespace

GridGeometry::GridGeometry(const Shape& shape, double h, const Workers& workers) {
  GeometryBuilder(*this, workers).build(shape, h);
}

bool GridGeometry::has_nested_coarse() const {
  return levels_.size() > 1 && levels_[1].joined_cells == 0;
}

std::int32_t GridGeometry::piece_at(std::int32_t cell, const Vec3& local) const {
  const std::int32_t first = finest().first_piece[static_cast<std::size_t>(cell)];
  if (first >= 0 && finest().whole(first)) return first;
  const auto split =
      std::lower_bound(splits_.begin(), splits_.end(), cell,
                       [](const auto& entry, std::int32_t wanted) { return entry.first < wanted; });
  if (split == splits_.end() || split->first != cell) return first;
  // The nearest of the lines that have a part inside, and on it the nearest part.
  const CellSample& sample = split->second;
  const double b = local[(sample.axis + 1) % 3], c = local[(sample.axis + 2) % 3];
  const double along = local[sample.axis];
  double best = 1e300;
  std::int32_t piece = first;
  for (int line = 0; line < 16; ++line) {
    const double db = ((line & 3) + 0.5) / lines_per_cell - b;
    const double dc = ((line >> 2) + 0.5) / lines_per_cell - c;
    for (const LinePart& part : sample.lines[static_cast<std::size_t>(line)]) {
      const double da = std::max({0.0, part.begin - along, along - part.end});
      const double distance = da * da + db * db + dc * dc;
      if (distance < best) {
        best = distance;
        piece = part.piece;
      }
    }
  }
  return piece;
}

Place GridGeometry::locate_in_cells(const Vec3& x, const Vec3& within) const {
  const Level& level = finest();
  std::array<int, 3> home;
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = std::floor(x[static_cast<Eigen::Index>(a)]);
    // Also false for NaN.
    if (!(at >= -1.0 && at <= level.grid.n[a])) return {};
    home[a] = static_cast<int>(at);
  }
  const auto local = [&](int i, int j, int k) -> Vec3 { return within - Vec3(i, j, k); };
  Place place;
  if (level.grid.contains(home[0], home[1], home[2]))
    place.piece =
        piece_at(level.grid.index(home[0], home[1], home[2]), local(home[0], home[1], home[2]));
  if (place.piece < 0) {
    double nearest = 1e300;
    for (int k = home[2] - 1; k <= home[2] + 1; ++k)
      for (int j = home[1] - 1; j <= home[1] + 1; ++j)
        for (int i = home[0] - 1; i <= home[0] + 1; ++i) {
          if (!level.grid.contains(i, j, k)) continue;
          const Vec3 x_local = local(i, j, k);
          const double distance = (x_local - x_local.cwiseMax(0.0).cwiseMin(1.0)).squaredNorm();
          if (distance >= nearest) continue;
          const std::int32_t piece = piece_at(level.grid.index(i, j, k), x_local);
          if (piece < 0) continue;
          nearest = distance;
          place.piece = piece;
        }
  }
  if (place.piece < 0) return {};
  const auto q = level.grid.position(level.pieces[static_cast<std::size_t>(place.piece)].cell);
  place.local =
      (x - Vec3(q[0], q[1], q[2])).cwiseMax(-farthest_outside).cwiseMin(1.0 + farthest_outside);
  return place;
}

Place GridGeometry::locate(const Vec3& x) const {
  const Vec3 at = finest().grid.to_cells(x);
  return locate_in_cells(at, at);
}

Place GridGeometry::locate(const Vec3& x, const Vec3& normal) const {
  const Vec3 at = finest().grid.to_cells(x);
  return locate_in_cells(at, at - step_inside * normal);
}

}  // namespace knotlight
