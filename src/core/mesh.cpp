#include "core/mesh.h"

#include <algorithm>
#include <cmath>

namespace knotlight {

Bounds bounds(const TriangleMesh& mesh) {
  Bounds box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) area += mesh.area(i);
  return area;
}

double signed_volume(const TriangleMesh& mesh) {
  // Tetrahedra from a point nearby: from a far origin they would cancel and lose digits.
  const Vec3 apex = bounds(mesh).center();
  double volume = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    volume += (mesh.corner(i, 0) - apex).dot(mesh.area_vector(i)) / 6.0;
  return volume;
}

Vec3 nearest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;

  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;

  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;

  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;

  const double va = d3 * d6 - d5 * d4;
  const double along_bc = d4 - d3;
  const double back_from_c = d5 - d6;
  if (va <= 0.0 && along_bc >= 0.0 && back_from_c >= 0.0)
    return b + along_bc / (along_bc + back_from_c) * (c - b);

  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

std::vector<Vec3> smooth_corner_normals(const TriangleMesh& mesh, double crease_cosine) {
  const std::size_t corners = 3 * mesh.triangles.size();
  std::vector<Vec3> facet_normals(mesh.triangles.size());
  std::vector<double> angles(corners);
  // The corners of vertex v are corner_of[first[v]] .. corner_of[first[v + 1] - 1].
  std::vector<std::size_t> first(mesh.vertices.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    facet_normals[t] = mesh.normal(t);
    for (int i = 0; i < 3; ++i) {
      const Vec3 e1 = mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i);
      const Vec3 e2 = mesh.corner(t, (i + 2) % 3) - mesh.corner(t, i);
      angles[3 * t + i] = std::atan2(e1.cross(e2).norm(), e1.dot(e2));
      ++first[mesh.triangles[t][i] + 1];
    }
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) first[v + 1] += first[v];
  std::vector<std::size_t> corner_of(corners);
  std::vector<std::size_t> next_free(first.begin(), first.end() - 1);
  for (std::size_t c = 0; c < corners; ++c)
    corner_of[next_free[mesh.triangles[c / 3][c % 3]]++] = c;

  std::vector<Vec3> normals(corners);
  for (std::size_t c = 0; c < corners; ++c) {
    const Vec3& own = facet_normals[c / 3];
    const std::uint32_t vertex = mesh.triangles[c / 3][c % 3];
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = first[vertex]; k < first[vertex + 1]; ++k) {
      const std::size_t other = corner_of[k];
      const Vec3& normal = facet_normals[other / 3];
      // The own facet counts even if rounding puts n . n below a crease cosine of 1.
      if (other == c || own.dot(normal) >= crease_cosine) sum += angles[other] * normal;
    }
    const double length = sum.norm();
    normals[c] = length > 0.0 ? Vec3(sum / length) : own;
  }
  return normals;
}

TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {  // bits of i: x, y, z at hi
    mesh.vertices.emplace_back((i & 1) != 0 ? hi.x() : lo.x(), (i & 2) != 0 ? hi.y() : lo.y(),
                               (i & 4) != 0 ? hi.z() : lo.z());
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

TriangleMesh quad_mesh(const Vec3& center, const Vec3& u, const Vec3& v) {
  return {{center - u - v, center + u - v, center + u + v, center - u + v}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace knotlight
