#include <algorithm>
#include <unordered_set>

#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

// Flat triangles that share their longest sides need several passes; 60 along one edge are done
// within these, and a mesh with hundreds is refused rather than worked on for minutes.
constexpr int max_passes = 32;

// The longest half-edge of the triangle if its opposite corner is nearer to it than the tolerance.
HalfEdge longest_if_flat(const TriangleMesh& mesh, std::uint32_t t, double tolerance) {
  double longest = 0.0;
  HalfEdge result = no_twin;
  for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
    const double length =
        (mesh.vertices[end_vertex(mesh, h)] - mesh.vertices[start_vertex(mesh, h)]).norm();
    if (length > longest) {
      longest = length;
      result = h;
    }
  }
  return mesh.area_vector(t).norm() < tolerance * longest ? result : no_twin;
}

// Half-edges: the longest sides of all flat triangles.
std::vector<HalfEdge> find_flat(const TriangleMesh& mesh, double tolerance) {
  std::vector<HalfEdge> flat;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const HalfEdge h = longest_if_flat(mesh, t, tolerance);
    if (h != no_twin) flat.push_back(h);
  }
  return flat;
}

// Turns the edges `flat`, of each triangle at most one. Returns whether any could be turned.
bool turn_edges(TriangleMesh& mesh, const std::vector<HalfEdge>& flat) {
  const std::vector<HalfEdge> twins = find_twins(mesh);
  std::unordered_set<std::uint64_t> edges;
  for (HalfEdge h = 0; h < twins.size(); ++h)
    edges.insert(edge_key(start_vertex(mesh, h), end_vertex(mesh, h)));
  std::vector<bool> touched(mesh.triangles.size(), false);
  bool turned = false;
  for (const HalfEdge h : flat) {
    const std::uint32_t t = h / 3;
    const std::uint32_t other = twins[h] / 3;
    if (touched[t] || touched[other]) continue;
    // t = (a, c, b) with b nearly on a - c; other = (c, a, d). Edge a - c becomes b - d.
    const std::uint32_t a = start_vertex(mesh, h);
    const std::uint32_t c = end_vertex(mesh, h);
    const std::uint32_t b = end_vertex(mesh, next_in_triangle(h));
    const std::uint32_t d = end_vertex(mesh, next_in_triangle(twins[h]));
    // Not where b - d is an edge already: four triangles would meet there.
    if (b == d || !edges.insert(edge_key(b, d)).second) continue;
    mesh.triangles[t] = {b, a, d};
    mesh.triangles[other] = {c, b, d};
    touched[t] = touched[other] = turned = true;
  }
  return turned;
}

}  // namespace

std::size_t remove_flat_triangles(TriangleMesh& mesh, double tolerance) {
  std::vector<HalfEdge> flat = find_flat(mesh, tolerance);
  const std::size_t before = flat.size();
  for (int pass = 0; pass < max_passes && !flat.empty() && turn_edges(mesh, flat); ++pass)
    flat = find_flat(mesh, tolerance);
  return before - std::min(before, flat.size());
}

}  // namespace knotlight
