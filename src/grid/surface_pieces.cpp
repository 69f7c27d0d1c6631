#include "grid/surface_pieces.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

// Of n corners a cut leaves 3n/2 at most, even if rounding has bent the polygon; two cuts per axis
// make 4, 6, 9, 13, 19, 28 of a triangle's three. Straight ones have no more than 9.
constexpr std::size_t most_corners = 28;
struct Polygon {
  std::array<Vec3, most_corners> corner;
  std::size_t corners = 0;

  void add(const Vec3& p) { corner[corners++] = p; }
};

// Which of two cells a piece in their common plane belongs to is decided this far under the
// surface: above rounding, far below any feature of a cell.
constexpr double step_inside = 1e-9;

// The part of a convex polygon with p[axis] on the given side of the plane.
void clip(const Polygon& polygon, int axis, double plane, double side, Polygon& result) {
  result.corners = 0;
  for (std::size_t v = 0; v < polygon.corners; ++v) {
    const Vec3& p = polygon.corner[v];
    const Vec3& q = polygon.corner[v + 1 == polygon.corners ? 0 : v + 1];
    const double dp = side * (p[axis] - plane), dq = side * (q[axis] - plane);
    if (dp >= 0.0) result.add(p);
    if ((dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0)) {
      Vec3 cut = p + dp / (dp - dq) * (q - p);
      cut[axis] = plane;
      result.add(cut);
    }
  }
}

// Slices along one axis after the other.
void slice(const Polygon& polygon, int axis, const Vec3& normal,
           const std::function<void(const SurfacePiece&)>& visit) {
  if (polygon.corners < 3) return;
  if (axis == 3) {
    for (std::size_t v = 1; v + 1 < polygon.corners; ++v) {
      SurfacePiece piece{
          {}, {polygon.corner[0], polygon.corner[v], polygon.corner[v + 1]}, normal, 0.0};
      piece.area =
          0.5 * (piece.corner[1] - piece.corner[0]).cross(piece.corner[2] - piece.corner[0]).norm();
      if (!(piece.area > 0.0)) continue;
      const Vec3 below =
          (piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3.0 - step_inside * normal;
      for (std::size_t a = 0; a < 3; ++a)
        piece.cell[a] = static_cast<int>(std::floor(below[static_cast<int>(a)]));
      visit(piece);
    }
    return;
  }
  double lo = polygon.corner[0][axis], hi = lo;
  for (std::size_t v = 1; v < polygon.corners; ++v) {
    lo = std::min(lo, polygon.corner[v][axis]);
    hi = std::max(hi, polygon.corner[v][axis]);
  }
  const int first = static_cast<int>(std::floor(lo));
  const int last = std::max(first, static_cast<int>(std::ceil(hi)) - 1);
  if (first == last) {
    slice(polygon, axis + 1, normal, visit);
    return;
  }
  Polygon above, slab;
  for (int i = first; i <= last; ++i) {
    clip(polygon, axis, i, 1.0, above);
    clip(above, axis, i + 1, -1.0, slab);
    slice(slab, axis + 1, normal, visit);
  }
}

}  // namespace

void for_each_surface_piece(const TriangleMesh& mesh, std::size_t triangle,
                            const std::function<void(const SurfacePiece&)>& visit) {
  if (!(mesh.area(triangle) > 0.0)) return;
  Polygon whole;
  for (int v = 0; v < 3; ++v) whole.add(mesh.corner(triangle, v));
  slice(whole, 0, mesh.normal(triangle), visit);
}

void for_each_surface_piece(const TriangleMesh& mesh,
                            const std::function<void(const SurfacePiece&)>& visit) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) for_each_surface_piece(mesh, t, visit);
}

std::array<SurfaceNode, 6> quadrature(const SurfacePiece& piece) {
  constexpr std::array<double, 2> weight{0.223381589678011, 0.109951743655322};
  constexpr std::array<double, 2> corner{0.108103018168070, 0.816847572980459};
  std::array<SurfaceNode, 6> nodes;
  for (std::size_t orbit = 0; orbit < 2; ++orbit)
    for (std::size_t v = 0; v < 3; ++v)
      nodes[3 * orbit + v] = {
          corner[orbit] * piece.corner[v] +
              0.5 * (1.0 - corner[orbit]) * (piece.corner[(v + 1) % 3] + piece.corner[(v + 2) % 3]),
          weight[orbit] * piece.area};
  return nodes;
}

}  // namespace knotlight
