// Which triangles share an edge, and what follows from it alone: the parts of the surface and a
// common orientation within each.
#include <fmt/format.h>

#include <algorithm>

#include "core/errors.h"
#include "scene/mesh_repair.h"

namespace knotlight {

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | std::max(a, b);
}

std::string coordinates(const Vec3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

Vec3 centroid(const TriangleMesh& mesh, std::size_t triangle) {
  return (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3.0;
}

namespace {

std::string edge_name(const TriangleMesh& mesh, HalfEdge h) {
  return fmt::format("edge between {} and {}", coordinates(mesh.vertices[start_vertex(mesh, h)]),
                     coordinates(mesh.vertices[end_vertex(mesh, h)]));
}

}  // namespace

std::vector<HalfEdge> find_twins(const TriangleMesh& mesh) {
  const auto count = static_cast<HalfEdge>(3 * mesh.triangles.size());
  std::vector<std::pair<std::uint64_t, HalfEdge>> edges;
  edges.reserve(count);
  for (HalfEdge h = 0; h < count; ++h)
    edges.emplace_back(edge_key(start_vertex(mesh, h), end_vertex(mesh, h)), h);
  std::sort(edges.begin(), edges.end());

  std::vector<HalfEdge> twins(count, no_twin);
  std::size_t crowded = 0;  // edges of more than two triangles
  std::string first_crowded;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end].first == edges[begin].first) ++end;
    if (end - begin == 2) {
      twins[edges[begin].second] = edges[begin + 1].second;
      twins[edges[begin + 1].second] = edges[begin].second;
    } else if (end - begin > 2 && crowded++ == 0) {
      first_crowded = fmt::format("{} belongs to {} triangles",
                                  edge_name(mesh, edges[begin].second), end - begin);
    }
    begin = end;
  }
  if (crowded > 0) {
    throw InputError(
        fmt::format("{}{}, expected 2 at every edge of a solid", first_crowded,
                    crowded > 1 ? fmt::format(" (and {} more edges like it)", crowded - 1) : ""));
  }
  return twins;
}

Parts find_parts(const TriangleMesh& mesh, const std::vector<HalfEdge>& twins) {
  constexpr std::uint32_t unseen = 0xffffffffU;
  Parts parts;
  parts.of_triangle.assign(mesh.triangles.size(), unseen);
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (parts.of_triangle[seed] != unseen) continue;
    parts.of_triangle[seed] = parts.count;
    waiting.push_back(seed);
    while (!waiting.empty()) {
      const std::uint32_t t = waiting.back();
      waiting.pop_back();
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (twins[h] == no_twin || parts.of_triangle[twins[h] / 3] != unseen) continue;
        parts.of_triangle[twins[h] / 3] = parts.count;
        waiting.push_back(twins[h] / 3);
      }
    }
    ++parts.count;
  }
  return parts;
}

std::size_t orient_consistently(TriangleMesh& mesh) {
  enum class Side : std::uint8_t { unknown, as_is, turned };
  const std::vector<HalfEdge> twins = find_twins(mesh);
  std::vector<Side> sides(mesh.triangles.size(), Side::unknown);
  std::size_t turned_in_all = 0;
  std::vector<std::uint32_t> part;  // triangles of the part at hand, in the order they are reached
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (sides[seed] != Side::unknown) continue;
    sides[seed] = Side::as_is;
    part.assign(1, seed);
    std::size_t turned = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::uint32_t t = part[k];
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (twins[h] == no_twin) continue;
        const std::uint32_t other = twins[h] / 3;
        const bool agree = start_vertex(mesh, h) == end_vertex(mesh, twins[h]);
        const Side wanted = agree == (sides[t] == Side::as_is) ? Side::as_is : Side::turned;
        if (sides[other] == Side::unknown) {
          sides[other] = wanted;
          turned += wanted == Side::turned ? 1 : 0;
          part.push_back(other);
        } else if (sides[other] != wanted) {
          throw InputError(
              fmt::format("surface is one-sided, like a Moebius strip, around the {}, expected an "
                          "inside and an outside",
                          edge_name(mesh, h)));
        }
      }
    }
    const bool turn_the_others = 2 * turned > part.size();
    const Side to_turn = turn_the_others ? Side::as_is : Side::turned;
    for (const std::uint32_t t : part)
      if (sides[t] == to_turn) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    turned_in_all += turn_the_others ? part.size() - turned : turned;
  }
  return turned_in_all;
}

}  // namespace knotlight
