// Triangle meshes as plain data, and the measures that the rest of the program asks of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace knotlight {

using Triangle = std::array<std::uint32_t, 3>;  // vertex indices, counter-clockwise from outside

struct Bounds {
  Vec3 lo = Vec3::Constant(1e300);
  Vec3 hi = Vec3::Constant(-1e300);

  void extend(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  Vec3 center() const { return 0.5 * (lo + hi); }
  double largest_extent() const { return (hi - lo).maxCoeff(); }
  double radius() const { return 0.5 * (hi - lo).norm(); }  // of the sphere around the box
};

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<Spectrum> colours = {};  // one per vertex, linear, 0..1; or none

  const Vec3& corner(std::size_t triangle, int i) const {
    return vertices[triangles[triangle][static_cast<std::size_t>(i)]];
  }
  // Twice the area, along the outward normal.
  Vec3 area_vector(std::size_t triangle) const {
    const Vec3 a = corner(triangle, 0);
    return (corner(triangle, 1) - a).cross(corner(triangle, 2) - a);
  }
  Vec3 normal(std::size_t triangle) const { return area_vector(triangle).normalized(); }
  double area(std::size_t triangle) const { return 0.5 * area_vector(triangle).norm(); }
};

Bounds bounds(const TriangleMesh& mesh);
double surface_area(const TriangleMesh& mesh);
// Signed volume by the divergence theorem; positive for outward orientation of a closed mesh.
double signed_volume(const TriangleMesh& mesh);

// The point of triangle (a, b, c) nearest to p [E05 ch. 5.1.5].
Vec3 nearest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// One smooth normal per triangle corner (3 per triangle): the average, weighted by corner angle, of
// the facet normals around the vertex that lie within `crease_cosine` of this facet's. For shading
// only; physics uses facet normals, which are exact for the polyhedron that is solved.
std::vector<Vec3> smooth_corner_normals(const TriangleMesh& mesh, double crease_cosine);

// The same surface with every edge longer than `max_edge` halved until none is left. Conforming:
// neighbours split their common edge together, so a closed mesh stays closed. Colours are
// interpolated.
TriangleMesh refine(TriangleMesh mesh, double max_edge);

// Axis-aligned box as a closed mesh of 12 triangles.
TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi);
// Parallelogram center +-u +-v as 2 triangles facing u x v.
TriangleMesh quad_mesh(const Vec3& center, const Vec3& u, const Vec3& v);

}  // namespace knotlight
