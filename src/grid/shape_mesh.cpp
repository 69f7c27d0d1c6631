#include "grid/shape_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Whole multiples of h up to rounding do not take another cell.
constexpr double rounding_slack = 1e-9;
constexpr int fewest_rows = 8;

TriangleMesh sphere_mesh(double radius, double edge) {
  const int rows = std::max(fewest_rows, static_cast<int>(std::ceil(pi * radius / edge)));
  const int columns = 2 * rows;
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0, 0.0, radius);
  for (int r = 1; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double theta = pi * r / rows, phi = 2.0 * pi * c / columns;
      mesh.vertices.emplace_back(radius * std::sin(theta) * std::cos(phi),
                                 radius * std::sin(theta) * std::sin(phi),
                                 radius * std::cos(theta));
    }
  mesh.vertices.emplace_back(0.0, 0.0, -radius);
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto vertex = [&](int r, int c) {
    if (r == 0) return std::uint32_t{0};
    if (r == rows) return bottom;
    return static_cast<std::uint32_t>(1 + (r - 1) * columns + c % columns);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      if (r + 1 < rows)
        mesh.triangles.push_back({vertex(r, c), vertex(r + 1, c), vertex(r + 1, c + 1)});
      if (r > 0) mesh.triangles.push_back({vertex(r, c), vertex(r + 1, c + 1), vertex(r, c + 1)});
    }
  const double scale = std::cbrt(4.0 / 3.0 * pi * radius * radius * radius / signed_volume(mesh));
  for (Vec3& v : mesh.vertices) v *= scale;
  return mesh;
}

}  // namespace

CellGrid grid_around(const Shape& shape, double h) {
  const Bounds box = bounds(shape);
  CellGrid grid;
  grid.h = h;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double cells = std::ceil((box.hi[axis] - box.lo[axis]) / h - rounding_slack) + 2.0;
    grid.n[a] = static_cast<int>(std::max(3.0, cells));
    grid.origin[axis] = box.center()[axis] - 0.5 * h * grid.n[a];
  }
  return grid;
}

TriangleMesh mesh_in_cells(const Shape& shape, const CellGrid& grid) {
  TriangleMesh mesh;
  if (const auto* given = std::get_if<TriangleMesh>(&shape)) {
    mesh = *given;
    for (Vec3& v : mesh.vertices) v = grid.to_cells(v);
  } else {
    const auto& sphere = std::get<Sphere>(shape);
    mesh = sphere_mesh(sphere.radius / grid.h, 1.0);
    const Vec3 center = grid.to_cells(sphere.center);
    for (Vec3& v : mesh.vertices) v += center;
  }
  return mesh;
}

}  // namespace knotlight
