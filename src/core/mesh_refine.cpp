// Conforming refinement: edges that are too long are marked for the whole mesh, then each triangle
// is cut into 2, 3 or 4 according to how many of its edges are marked. Neighbours see the same
// marks, so no vertex is left hanging on an edge.
#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "core/mesh.h"

namespace knotlight {
namespace {

// Edges of a few roundings of the coordinates have no midpoint between their ends.
constexpr double shortest_edge_in_roundings = 16.0;

using Midpoints = std::unordered_map<std::uint64_t, std::uint32_t>;  // edge -> vertex

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | std::max(a, b);
}

// Adds the midpoint of every edge longer than max_edge, in the order of the triangles.
Midpoints mark_long_edges(TriangleMesh& mesh, double max_edge) {
  Midpoints midpoints;
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      if ((mesh.vertices[b] - mesh.vertices[a]).norm() <= max_edge) continue;
      if (mesh.vertices.size() >= std::numeric_limits<std::uint32_t>::max())
        throw std::length_error("the refined mesh has more vertices than 32 bits can number");
      const auto vertex = static_cast<std::uint32_t>(mesh.vertices.size());
      if (!midpoints.emplace(edge_key(a, b), vertex).second) continue;
      mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      if (!mesh.colours.empty()) mesh.colours.push_back(0.5 * (mesh.colours[a] + mesh.colours[b]));
    }
  }
  return midpoints;
}

// Splits one triangle at the midpoints m of its edges (m[i] between corners i and i + 1; present
// where marked[i]).
void split(const TriangleMesh& mesh, const Triangle& t, const std::array<bool, 3>& marked,
           const Triangle& m, std::vector<Triangle>& out) {
  const int count = marked[0] + marked[1] + marked[2];
  if (count == 0) {
    out.push_back(t);
  } else if (count == 3) {
    out.insert(out.end(), {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]},
                           Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}});
  } else if (count == 1) {
    const std::size_t i = marked[0] ? 0 : marked[1] ? 1 : 2;
    const std::uint32_t opposite = t[(i + 2) % 3];
    out.insert(out.end(),
               {Triangle{t[i], m[i], opposite}, Triangle{m[i], t[(i + 1) % 3], opposite}});
  } else {
    // a - b is the edge that stays, c the corner between the marked ones.
    const std::size_t i = !marked[0] ? 0 : !marked[1] ? 1 : 2;
    const std::uint32_t a = t[i];
    const std::uint32_t b = t[(i + 1) % 3];
    const std::uint32_t c = t[(i + 2) % 3];
    const std::uint32_t on_bc = m[(i + 1) % 3];
    const std::uint32_t on_ca = m[(i + 2) % 3];
    out.push_back({on_ca, on_bc, c});
    const auto& p = mesh.vertices;
    if ((p[a] - p[on_bc]).squaredNorm() <= (p[b] - p[on_ca]).squaredNorm()) {
      out.insert(out.end(), {Triangle{a, b, on_bc}, Triangle{a, on_bc, on_ca}});
    } else {
      out.insert(out.end(), {Triangle{a, b, on_ca}, Triangle{b, on_bc, on_ca}});
    }
  }
}

}  // namespace

// It ends: with L the longest edge and m = max_edge < L, the new edges of a triangle are halves of
// its edges, midlines (half of an edge), the median to its only marked edge (at most m), or the
// shorter diagonal, which is at most the median to the longer of two marked edges, so its square is
// at most (L^2 + 2 m^2) / 4. So L^2 - (2/3) m^2 falls to a quarter or L to a half in every pass.
TriangleMesh refine(TriangleMesh mesh, double max_edge) {
  assert(max_edge > 0.0);
  double largest = 0.0;
  for (const Vec3& vertex : mesh.vertices)
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  const double limit = std::max(
      max_edge, shortest_edge_in_roundings * std::numeric_limits<double>::epsilon() * largest);
  while (true) {
    const Midpoints midpoints = mark_long_edges(mesh, limit);
    if (midpoints.empty()) return mesh;
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size() + 2 * midpoints.size());
    for (const Triangle& t : mesh.triangles) {
      std::array<bool, 3> marked{};
      Triangle m{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto found = midpoints.find(edge_key(t[i], t[(i + 1) % 3]));
        marked[i] = found != midpoints.end();
        if (marked[i]) m[i] = found->second;
      }
      split(mesh, t, marked, m, triangles);
    }
    mesh.triangles = std::move(triangles);
  }
}

}  // namespace knotlight
