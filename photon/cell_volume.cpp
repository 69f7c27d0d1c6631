#include "photon/cell_volume.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace knotlight {
namespace {

using std::numbers::pi;

// The measure of a mesh: the vertical line through (x, y) runs inside below each
// piece of surface that faces up and above each that faces down; between z0 and z1 the length of it
// that is inside is therefore the sum over the pieces it meets of
//   +-(clamp(z, z0, z1) - z0),   + where the surface faces up.
// Each triangle adds the integral of that over its projection, whose signed area knows the sign.

// Below this share of a cell a volume may be rounding alone.
constexpr double least_cell_share = 1e-12;

using Polygon = std::vector<Vec3>;

// The part of a convex polygon with side * (p[axis] - border) >= 0.
Polygon clip(const Polygon& polygon, int axis, double border, double side) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double da = side * (a[axis] - border);
    const double db = side * (b[axis] - border);
    if (da >= 0.0) kept.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      Vec3 p = a + da / (da - db) * (b - a);
      p[axis] = border;
      kept.push_back(p);
    }
  }
  return kept;
}

// Integral of z - z0 over the projection of a planar polygon, counted negative where it faces down:
// exact, as the height is linear on the triangles of the fan.
double volume_above(const Polygon& polygon, double z0) {
  double sum = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i - 1] - polygon[0];
    const Vec3 b = polygon[i] - polygon[0];
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    sum += area * ((polygon[0].z() + polygon[i - 1].z() + polygon[i].z()) / 3.0 - z0);
  }
  return sum;
}

int index_of(const FluxGrid& grid, int axis, double x) {
  const double i = (x - grid.lo[axis]) / (grid.hi[axis] - grid.lo[axis]) * grid.n[axis];
  return static_cast<int>(std::clamp(std::floor(i), 0.0, grid.n[axis] - 1.0));
}

// The indices that [lo, hi] overlaps on an axis, with one more on either side against rounding.
std::pair<int, int> index_range(const FluxGrid& grid, int axis, double lo, double hi) {
  return {std::max(index_of(grid, axis, lo) - 1, 0),
          std::min(index_of(grid, axis, hi) + 1, grid.n[axis] - 1)};
}

// What the part of a triangle over column (i, j) adds to the column's cells.
void add_to_column(const Polygon& piece, const FluxGrid& grid, int i, int j,
                   std::vector<double>& volumes) {
  for (int k = 0; k < grid.n[2]; ++k) {
    const double z0 = grid.border(2, k);
    const double z1 = grid.border(2, k + 1);
    const Polygon above = clip(piece, 2, z0, 1.0);
    if (above.size() < 3) return;  // it lies below all further cells too
    volumes[grid.number({i, j, k})] +=
        volume_above(above, z0) - volume_above(clip(above, 2, z1, 1.0), z1);
  }
}

std::vector<double> inside_mesh(const TriangleMesh& mesh, const FluxGrid& grid) {
  std::vector<double> volumes(grid.cells(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Polygon triangle{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    Bounds b;
    for (const Vec3& p : triangle) b.extend(p);
    const bool beside = b.lo.x() > grid.hi.x() || b.hi.x() < grid.lo.x() ||
                        b.lo.y() > grid.hi.y() || b.hi.y() < grid.lo.y();
    if (beside || b.hi.z() < grid.lo.z()) continue;
    const auto [i0, i1] = index_range(grid, 0, b.lo.x(), b.hi.x());
    const auto [j0, j1] = index_range(grid, 1, b.lo.y(), b.hi.y());
    for (int i = i0; i <= i1; ++i) {
      const Polygon strip =
          clip(clip(triangle, 0, grid.border(0, i), 1.0), 0, grid.border(0, i + 1), -1.0);
      for (int j = j0; j <= j1; ++j) {
        const Polygon piece =
            clip(clip(strip, 1, grid.border(1, j), 1.0), 1, grid.border(1, j + 1), -1.0);
        if (piece.size() >= 3) add_to_column(piece, grid, i, j, volumes);
      }
    }
  }
  return volumes;
}

// Area of the part of the disc of radius r about the origin in the rectangle between the origin and
// (x, y), negative where x and y differ in sign.
double disc_in_quadrant(double x, double y, double r) {
  const double a = std::min(std::abs(x), r);
  const double b = std::min(std::abs(y), r);
  const double sign = (x < 0.0) == (y < 0.0) ? 1.0 : -1.0;
  if (a * a + b * b <= r * r) return sign * a * b;
  // The rectangle's height is b up to c, then the circle's.
  const double c = std::sqrt(r * r - b * b);
  const auto under_circle = [r](double s) {
    return 0.5 * (s * std::sqrt(r * r - s * s) + r * r * std::asin(s / r));
  };
  return sign * (b * c + under_circle(a) - under_circle(c));
}

// Points each side of the middle and step of the double exponential rule on (-1, 1) [TM74]; with
// them it integrates what has square roots at its ends to 1e-12.
constexpr int rule_points = 32;
constexpr double rule_step = 0.1;

// Volume of the part of the ball about the origin in a box: the area of the disc at height z in the
// rectangle, integrated over the pieces of [z0, z1] on which it is smooth.
double ball_in_box(double radius, const Vec3& lo, const Vec3& hi) {
  const double z0 = std::clamp(lo.z(), -radius, radius);
  const double z1 = std::clamp(hi.z(), -radius, radius);
  std::vector<double> breaks{z0, z1};
  for (const double x : {0.0, lo.x(), hi.x()})
    for (const double y : {0.0, lo.y(), hi.y()})
      if (const double z2 = radius * radius - x * x - y * y; z2 > 0.0)
        for (const double z : {-std::sqrt(z2), std::sqrt(z2)})
          if (z > z0 && z < z1) breaks.push_back(z);
  std::sort(breaks.begin(), breaks.end());
  double volume = 0.0;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double middle = 0.5 * (breaks[i] + breaks[i - 1]);
    const double half = 0.5 * (breaks[i] - breaks[i - 1]);
    for (int p = -rule_points; p <= rule_points; ++p) {
      const double s = 0.5 * pi * std::sinh(rule_step * p);
      const double weight =
          rule_step * 0.5 * pi * std::cosh(rule_step * p) / (std::cosh(s) * std::cosh(s));
      const double z = middle + half * std::tanh(s);
      const double r = std::sqrt(std::max(0.0, (radius - z) * (radius + z)));
      if (r == 0.0) continue;  // no disc at the pole
      volume += half * weight *
                (disc_in_quadrant(hi.x(), hi.y(), r) - disc_in_quadrant(lo.x(), hi.y(), r) -
                 disc_in_quadrant(hi.x(), lo.y(), r) + disc_in_quadrant(lo.x(), lo.y(), r));
    }
  }
  return volume;
}

}  // namespace

std::vector<double> volumes_inside(const Shape& shape, const FluxGrid& grid) {
  std::vector<double> volumes;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    for (std::size_t c = 0; c < grid.cells(); ++c) {
      const Bounds b = grid.cell_bounds(c);
      volumes.push_back(ball_in_box(sphere->radius, b.lo - sphere->center, b.hi - sphere->center));
    }
  } else {
    volumes = inside_mesh(std::get<TriangleMesh>(shape), grid);
  }
  const double least = least_cell_share * grid.cell_size().prod();
  for (double& v : volumes)
    if (v < least) v = 0.0;
  return volumes;
}

}  // namespace knotlight
