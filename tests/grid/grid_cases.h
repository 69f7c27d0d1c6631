// Shapes, quadrature and exact solutions that the grid tests share.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/shape.h"
#include "grid/shape_mesh.h"
#include "grid/solver.h"
#include "grid/surface_pieces.h"

namespace knotlight::grid_cases {

using std::numbers::pi;

inline Workers workers() {
  return Workers(2);
}

inline std::shared_ptr<const GridGeometry> geometry(const Shape& shape, double h) {
  return std::make_shared<const GridGeometry>(shape, h, workers());
}

// Axis-free orientation: no face along a grid plane.
inline Eigen::Matrix3d tilt() {
  return (Eigen::AngleAxisd(0.5, Vec3::UnitX()) * Eigen::AngleAxisd(0.7, Vec3::UnitZ()))
      .toRotationMatrix();
}

inline TriangleMesh tilted_box(const Vec3& half) {
  TriangleMesh mesh = box_mesh(-half, half);
  for (Vec3& v : mesh.vertices) v = tilt() * v;
  return mesh;
}

inline TriangleMesh torus(double R, double r, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2.0 * pi * i / around, b = 2.0 * pi * j / across;
      const double d = R + r * std::cos(b);
      mesh.vertices.push_back(tilt() * Vec3(d * std::cos(a), d * std::sin(a), r * std::sin(b)));
    }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>(i % around * across + j % across);
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

// Random surface points, one in each of `count` strata of equal area.
struct Samples {
  Points positions, normals;
  Eigen::VectorXd areas;
};
inline Samples samples(const Shape& shape, std::size_t count) {
  const auto points = stratified_surface_points(shape, count, true, 1, Stream::tests);
  const auto n = static_cast<Eigen::Index>(count);
  Samples s{Points(3, n), Points(3, n),
            Eigen::VectorXd::Constant(n, surface_area(shape) / static_cast<double>(count))};
  for (Eigen::Index i = 0; i < n; ++i) {
    s.positions.col(i) = points[static_cast<std::size_t>(i)].position;
    s.normals.col(i) = points[static_cast<std::size_t>(i)].normal;
  }
  return s;
}

// Quadrature over the surface as the grid sees it, exact for polynomials of degree 4 in each cell.
inline Samples surface_quadrature(const Shape& shape, const CellGrid& grid) {
  std::vector<SurfaceNode> nodes;
  std::vector<Vec3> normals;
  for_each_surface_piece(mesh_in_cells(shape, grid), [&](const SurfacePiece& piece) {
    for (const SurfaceNode& node : quadrature(piece)) {
      nodes.push_back(node);
      normals.push_back(piece.normal);
    }
  });
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Samples s{Points(3, n), Points(3, n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const SurfaceNode& node = nodes[static_cast<std::size_t>(i)];
    s.positions.col(i) = grid.origin + grid.h * node.position;
    s.normals.col(i) = normals[static_cast<std::size_t>(i)];
    s.areas[i] = grid.h * grid.h * node.weight;
  }
  return s;
}

// Relative L2 difference over the surface points.
template <class Exact>
double surface_error(const GridField& field, const Samples& at, const Exact& exact) {
  double error = 0.0, size = 0.0;
  for (Eigen::Index i = 0; i < at.positions.cols(); ++i) {
    const double u = exact(at.positions.col(i));
    const double d = field.value(at.positions.col(i), at.normals.col(i)) - u;
    error += d * d;
    size += u * u;
  }
  return std::sqrt(error / size);
}

// sinh(x)/x and its derivative.
inline double i0(double x) {
  return x < 1e-4 ? 1.0 + x * x / 6.0 : std::sinh(x) / x;
}
inline double i0_slope(double x) {
  return x < 1e-4 ? x / 3.0 : (x * std::cosh(x) - std::sinh(x)) / (x * x);
}

}  // namespace knotlight::grid_cases
