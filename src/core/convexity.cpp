#include "core/convexity.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace knotlight {
namespace {

constexpr double flat = 1e-6;  // of an edge: vertices come from files in single precision

struct EdgeSide {
  std::uint32_t low, high;  // vertices of the edge
  std::uint32_t triangle;
  std::uint32_t opposite;  // the triangle's third vertex
};

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

bool is_convex_mesh(const TriangleMesh& mesh) {
  std::vector<EdgeSide> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i];
      const std::uint32_t b = mesh.triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, mesh.triangles[t][(i + 2) % 3]});
    }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& x, const EdgeSide& y) {
    return std::pair(x.low, x.high) < std::pair(y.low, y.high);
  });
  std::vector<std::size_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const EdgeSide& x = sides[i];
    const EdgeSide& y = sides[i + 1];
    if (x.low != y.low || x.high != y.high) continue;
    const Vec3 across = mesh.vertices[y.opposite] - mesh.vertices[x.low];
    if (mesh.normal(x.triangle).dot(across) > flat * across.norm()) return false;
    parent[root_of(parent, x.triangle)] = root_of(parent, y.triangle);
  }
  for (std::size_t t = 1; t < parent.size(); ++t)
    if (root_of(parent, t) != root_of(parent, 0)) return false;
  return true;
}

}  // namespace

bool is_convex(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  return mesh == nullptr || is_convex_mesh(*mesh);
}

}  // namespace knotlight
