#include <fmt/format.h>

#include <algorithm>

#include "core/errors.h"
#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

// What is closed without asking: small enough that no reader of the picture could tell.
constexpr std::size_t max_hole_edges = 32;
constexpr double max_hole_fraction = 0.05;  // of the mesh's size

// The border of one hole: its vertices in the order in which the surface runs along them.
using Loop = std::vector<std::uint32_t>;

// Cuts a border that comes back to one of its vertices, as where two holes meet, into loops that do
// not.
void append_simple_loops(const Loop& border, std::vector<Loop>& loops) {
  Loop open;
  for (const std::uint32_t v : border) {
    const auto again = std::find(open.begin(), open.end(), v);
    if (again != open.end()) {
      loops.emplace_back(again, open.end());
      open.erase(again, open.end());
    }
    open.push_back(v);
  }
  loops.push_back(std::move(open));
}

// Follows every border. At a vertex where several meet, the walk stays with the fan of triangles it
// came along, so it always comes back to its start.
std::vector<Loop> border_loops(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> twins = find_twins(mesh);
  std::vector<bool> seen(twins.size(), false);
  std::vector<Loop> loops;
  for (HalfEdge first = 0; first < twins.size(); ++first) {
    if (twins[first] != no_twin || seen[first]) continue;
    Loop border;
    for (HalfEdge h = first; !seen[h];) {
      seen[h] = true;
      border.push_back(start_vertex(mesh, h));
      h = next_in_triangle(h);
      while (twins[h] != no_twin) h = next_in_triangle(twins[h]);
    }
    append_simple_loops(border, loops);
  }
  return loops;
}

Bounds loop_bounds(const TriangleMesh& mesh, const Loop& loop) {
  Bounds box;
  for (const std::uint32_t v : loop) box.extend(mesh.vertices[v]);
  return box;
}

Vec3 loop_center(const TriangleMesh& mesh, const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t v : loop) sum += mesh.vertices[v];
  return sum / static_cast<double>(loop.size());
}

bool may_be_filled(const TriangleMesh& mesh, const Loop& loop, double largest) {
  return loop.size() <= max_hole_edges && loop_bounds(mesh, loop).radius() <= largest;
}

// Three edges need one triangle; more get a fan around their centre.
void fill(TriangleMesh& mesh, const Loop& loop) {
  if (loop.size() == 3) {
    mesh.triangles.push_back({loop[2], loop[1], loop[0]});
    return;
  }
  const auto center = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(loop_center(mesh, loop));
  for (std::size_t i = 0; i < loop.size(); ++i)
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], center});
}

}  // namespace

std::size_t fill_holes(TriangleMesh& mesh) {
  const std::vector<Loop> loops = border_loops(mesh);
  const double largest = max_hole_fraction * bounds(mesh).radius();
  const Loop* worst = nullptr;
  std::size_t refused = 0;
  for (const Loop& loop : loops) {
    if (may_be_filled(mesh, loop, largest)) continue;
    ++refused;
    if (worst == nullptr || loop_bounds(mesh, loop).radius() > loop_bounds(mesh, *worst).radius())
      worst = &loop;
  }
  if (worst != nullptr) {
    throw InputError(fmt::format("hole of {} edges around {}{}, expected a closed surface",
                                 worst->size(), coordinates(loop_center(mesh, *worst)),
                                 refused > 1 ? fmt::format(" (and {} more)", refused - 1) : ""));
  }
  for (const Loop& loop : loops) fill(mesh, loop);
  return loops.size();
}

}  // namespace knotlight
