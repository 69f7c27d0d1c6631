#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "scene/mesh_reader.h"
#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// A cell is large against the tolerance, so that nearly always only one must be searched; and never
// so small against the mesh that its coordinates overflow.
constexpr double cell_in_tolerances = 8.0;
constexpr double smallest_cell_fraction = 1e-9;

// Sets of vertices; the representative of a set is its smallest index.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Vertices by grid cell. Different cells may share a list if their hashes agree: that costs a few
// comparisons and changes nothing.
class VertexGrid {
 public:
  VertexGrid(const std::vector<Vec3>& vertices, const Vec3& origin, double cell)
      : vertices_(vertices), origin_(origin), cell_(cell), next_(vertices.size(), none) {}

  void insert(std::uint32_t i) {
    const auto [head, is_new] = heads_.emplace(key(cell_of(vertices_[i])), i);
    if (is_new) return;
    next_[i] = head->second;
    head->second = i;
  }

  // Calls visit(j) for the vertices of all cells within `reach` of p until it returns true.
  template <class Visit>
  void for_near(const Vec3& p, double reach, const Visit& visit) const {
    const Cell lo = cell_of(p - Vec3::Constant(reach));
    const Cell hi = cell_of(p + Vec3::Constant(reach));
    for (std::int64_t x = lo[0]; x <= hi[0]; ++x)
      for (std::int64_t y = lo[1]; y <= hi[1]; ++y)
        for (std::int64_t z = lo[2]; z <= hi[2]; ++z) {
          const auto head = heads_.find(key({x, y, z}));
          if (head == heads_.end()) continue;
          for (std::uint32_t j = head->second; j != none; j = next_[j])
            if (visit(j)) return;
        }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3& p) const {
    const Vec3 q = (p - origin_) / cell_;
    return {static_cast<std::int64_t>(std::floor(q.x())),
            static_cast<std::int64_t>(std::floor(q.y())),
            static_cast<std::int64_t>(std::floor(q.z()))};
  }
  static std::uint64_t key(const Cell& cell) {
    std::uint64_t h = 0;
    for (const std::int64_t x : cell) {
      h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 29U;
    }
    return h;
  }

  const std::vector<Vec3>& vertices_;
  Vec3 origin_;
  double cell_;
  std::unordered_map<std::uint64_t, std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), none);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) new_index[v] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] == none) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    if (!mesh.colours.empty()) mesh.colours[kept] = mesh.colours[v];
    new_index[v] = kept++;
  }
  mesh.vertices.resize(kept);
  if (!mesh.colours.empty()) mesh.colours.resize(kept);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = new_index[v];
}

std::size_t merge_vertices(TriangleMesh& mesh, double tolerance) {
  assert(tolerance >= 0.0);
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  const Bounds box = bounds(mesh);
  const double cell =
      std::max(cell_in_tolerances * tolerance, smallest_cell_fraction * box.largest_extent());
  DisjointSets sets(n);
  const auto same_colour = [&mesh](std::uint32_t a, std::uint32_t b) {
    return mesh.colours.empty() || (mesh.colours[a] == mesh.colours[b]).all();
  };
  VertexGrid grid(mesh.vertices, box.lo, cell > 0.0 ? cell : 1.0);
  for (std::uint32_t i = 0; i < n; ++i) {
    bool is_copy = false;
    grid.for_near(mesh.vertices[i], tolerance, [&](std::uint32_t j) {
      if (!same_colour(i, j)) return false;
      const double distance2 = (mesh.vertices[i] - mesh.vertices[j]).squaredNorm();
      if (distance2 <= tolerance * tolerance) sets.unite(i, j);
      return is_copy = distance2 == 0.0;
    });
    // An exact copy brings no new neighbours; left out, a thousand copies stay cheap.
    if (!is_copy) grid.insert(i);
  }

  std::size_t merged = 0;
  for (std::uint32_t i = 0; i < n; ++i) merged += sets.find(i) != i ? 1 : 0;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = sets.find(v);
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  drop_unused_vertices(mesh);
  return merged;
}

}  // namespace knotlight
