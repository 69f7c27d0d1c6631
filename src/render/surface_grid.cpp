#include "render/surface_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Face coordinates in [-1, 1] are tangents of equal angles, so that cells are of nearly equal size.
Vec3 cube_direction(int face, double a, double b) {
  const double x = std::tan(0.25 * pi * a);
  const double y = std::tan(0.25 * pi * b);
  const int axis = face / 2;
  Vec3 d;
  d[axis] = face % 2 == 0 ? 1.0 : -1.0;
  d[(axis + 1) % 3] = x;
  d[(axis + 2) % 3] = y;
  return d.normalized();
}

}  // namespace

SurfaceGrid::SurfaceGrid(const Shape& shape, int cells) : mesh_(std::get_if<TriangleMesh>(&shape)) {
  if (mesh_ != nullptr) {
    nodes_.resize(3, static_cast<Eigen::Index>(mesh_->vertices.size()));
    for (Eigen::Index i = 0; i < nodes_.cols(); ++i)
      nodes_.col(i) = mesh_->vertices[static_cast<std::size_t>(i)];
    return;
  }
  const auto& sphere = std::get<Sphere>(shape);
  center_ = sphere.center;
  cells_ = cells;
  const int side = cells + 1;
  nodes_.resize(3, 6L * side * side);
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        nodes_.col((static_cast<Eigen::Index>(face) * side + j) * side + i) =
            center_ +
            sphere.radius * cube_direction(face, 2.0 * i / cells - 1.0, 2.0 * j / cells - 1.0);
}

double SurfaceGrid::interpolate(const Eigen::VectorXd& values, const Hit& hit) const {
  if (mesh_ != nullptr) {
    const Triangle& corners = mesh_->triangles[hit.primitive];
    return (1.0 - hit.b1 - hit.b2) * values[corners[0]] + hit.b1 * values[corners[1]] +
           hit.b2 * values[corners[2]];
  }
  const Vec3 d = hit.position - center_;
  int axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  const int face = 2 * axis + (d[axis] > 0.0 ? 0 : 1);
  const double scale = 1.0 / std::abs(d[axis]);
  const auto cell_coordinate = [&](double tangent) {
    return (std::atan(tangent) * 4.0 / pi + 1.0) * 0.5 * cells_;
  };
  const double a = cell_coordinate(d[(axis + 1) % 3] * scale);
  const double b = cell_coordinate(d[(axis + 2) % 3] * scale);
  const int i = std::clamp(static_cast<int>(a), 0, cells_ - 1);
  const int j = std::clamp(static_cast<int>(b), 0, cells_ - 1);
  const double s = a - i;
  const double t = b - j;
  const int side = cells_ + 1;
  const auto at = [&](int column, int row) {
    return values[(static_cast<Eigen::Index>(face) * side + row) * side + column];
  };
  return (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i + 1, j)) +
         t * ((1.0 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

}  // namespace knotlight
