#include "stability/shapes.h"

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

// The vertices of an octahedron: +x, -x, +y, -y, +z, -z.
std::vector<Vec3> axis_points() {
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) points.push_back(side * Vec3::Unit(axis));
  return points;
}

// Its face in the octant of the given signs (bit set: negative), outward.
Triangle octant_face(std::uint32_t octant) {
  const std::uint32_t x = octant & 1U, y = 2U + (octant >> 1U & 1U), z = 4U + (octant >> 2U & 1U);
  const bool mirrored = ((octant ^ octant >> 1U ^ octant >> 2U) & 1U) != 0;
  return mirrored ? Triangle{x, z, y} : Triangle{x, y, z};
}

}  // namespace

TriangleMesh ellipsoid_mesh(const Vec3& center, const Vec3& half_axes, double detail) {
  TriangleMesh mesh{axis_points(), {}};
  for (std::uint32_t octant = 0; octant < 8; ++octant)
    mesh.triangles.push_back(octant_face(octant));
  mesh = refine(std::move(mesh), detail);
  for (Vec3& v : mesh.vertices) v = center + half_axes.cwiseProduct(v.normalized());
  return mesh;
}

TriangleMesh tetrahedron_mesh(const Vec3& tip, const Vec3& base, double height) {
  const Frame frame(base);
  const double radius = height / std::sqrt(2.0);  // of the circle around the base
  TriangleMesh mesh{{tip}, {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}}};
  for (int i = 0; i < 3; ++i) {
    const double turn = 2.0 * std::numbers::pi / 3.0 * i;
    mesh.vertices.push_back(
        tip + frame.to_world({radius * std::cos(turn), radius * std::sin(turn), height}));
  }
  return mesh;
}

TriangleMesh star_mesh() {
  TriangleMesh mesh{axis_points(), {}};
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const auto sign = [&](unsigned bit) { return (octant >> bit & 1U) != 0 ? -1.0 : 1.0; };
    const auto spike = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({sign(0), sign(1), sign(2)});
    const Triangle face = octant_face(octant);
    for (std::size_t i = 0; i < 3; ++i)
      mesh.triangles.push_back({face[i], face[(i + 1) % 3], spike});
  }
  return mesh;
}

TriangleMesh both(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

}  // namespace knotlight
