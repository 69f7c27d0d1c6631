// Which side of a closed surface is outside, when it may consist of several parts of which some
// are cavities of others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/errors.h"
#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Vertices asked whether one part lies within another: more than one, so that parts that merely
// cross are not taken for nested.
constexpr std::size_t asked_vertices = 8;

struct Part {
  TriangleMesh mesh;  // shares no vertex indices with the whole
  std::vector<std::uint32_t> triangles;
  Bounds box;
  double volume = 0.0;  // signed, as read
  std::vector<std::size_t> containers;
  std::size_t root = 0;  // its container that has none itself, or the part
  bool turn = false;
  bool leave_out = false;
};

std::vector<Part> split_into_parts(const TriangleMesh& mesh) {
  const Parts numbers = find_parts(mesh, find_twins(mesh));
  std::vector<Part> parts(numbers.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    parts[numbers.of_triangle[t]].triangles.push_back(t);
  for (Part& part : parts) {
    for (const std::uint32_t t : part.triangles) part.mesh.triangles.push_back(mesh.triangles[t]);
    if (numbers.count == 1) {
      part.mesh.vertices = mesh.vertices;
    } else {
      std::vector<std::uint32_t> used;
      for (const Triangle& t : part.mesh.triangles) used.insert(used.end(), t.begin(), t.end());
      std::sort(used.begin(), used.end());
      used.erase(std::unique(used.begin(), used.end()), used.end());
      for (const std::uint32_t v : used) part.mesh.vertices.push_back(mesh.vertices[v]);
      for (Triangle& t : part.mesh.triangles)
        for (std::uint32_t& v : t)
          v = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) -
                                         used.begin());
    }
    part.box = bounds(part.mesh);
    part.volume = signed_volume(part.mesh);
  }
  return parts;
}

// How often the closed mesh winds around p: the solid angle of all its triangles over 4 pi, each by
// the formula of van Oosterom and Strackee [OS83 eq. 8].
double winding_number(const TriangleMesh& mesh, const Vec3& p) {
  double half_angles = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - p;
    const Vec3 b = mesh.corner(t, 1) - p;
    const Vec3 c = mesh.corner(t, 2) - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * pi);
}

bool lies_within(const Part& inner, const Part& outer) {
  if ((inner.box.lo.array() < outer.box.lo.array()).any() ||
      (inner.box.hi.array() > outer.box.hi.array()).any()) {
    return false;
  }
  const std::size_t n = inner.mesh.vertices.size();
  const std::size_t step = std::max<std::size_t>(1, n / asked_vertices);
  for (std::size_t v = 0; v < n; v += step)
    if (std::abs(winding_number(outer.mesh, inner.mesh.vertices[v])) < 0.5) return false;
  return true;
}

void find_containers(std::vector<Part>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].root = i;
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (i != j && lies_within(parts[i], parts[j])) parts[i].containers.push_back(j);
  }
  for (Part& part : parts)
    for (const std::size_t j : part.containers)
      if (parts[j].containers.empty()) part.root = j;
}

// Containers before what they contain.
std::vector<std::size_t> from_outside_in(const std::vector<Part>& parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return parts[a].containers.size() < parts[b].containers.size();
  });
  return order;
}

bool faces_outward(const Part& part) {
  return (part.volume > 0.0) != part.turn;
}

}  // namespace

void orient_outward(TriangleMesh& mesh, double tolerance, std::vector<std::string>& warnings) {
  std::vector<Part> parts = split_into_parts(mesh);
  for (const Part& part : parts) {
    // Thinner, in the mean, than positions are known.
    if (std::abs(part.volume) <= tolerance * surface_area(part.mesh)) {
      throw InputError(fmt::format("{} around {} has no volume, expected a solid",
                                   parts.size() > 1 ? "closed part" : "surface",
                                   coordinates(part.box.center())));
    }
  }
  find_containers(parts);
  std::size_t turned = 0;
  for (const std::size_t i : from_outside_in(parts)) {
    Part& part = parts[i];
    // A file that is inside out as a whole is turned with all its cavities.
    part.turn = parts[part.root].volume < 0.0;
    int depth = 0;  // of material around the part
    for (const std::size_t j : part.containers)
      if (!parts[j].leave_out) depth += faces_outward(parts[j]) ? 1 : -1;
    if (depth <= 0) part.turn = part.volume < 0.0;  // in empty space: a solid of its own
    part.leave_out = depth > 0 && faces_outward(part);
    if (part.leave_out) {
      warnings.push_back(fmt::format(
          "part of {} triangles around {} lies inside another and faces outward like it; it adds "
          "nothing and is left out (facing inward it would be a cavity)",
          part.triangles.size(), coordinates(part.box.center())));
    }
    turned += part.turn && !part.leave_out ? part.triangles.size() : 0;
  }
  if (turned > 0)
    warnings.push_back(
        fmt::format("triangles of surfaces that were inside out turned: {}", turned));

  std::vector<bool> keep(mesh.triangles.size(), true);
  for (const Part& part : parts) {
    for (const std::uint32_t t : part.triangles) {
      if (part.turn) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      keep[t] = !part.leave_out;
    }
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (keep[t]) mesh.triangles[kept++] = mesh.triangles[t];
  mesh.triangles.resize(kept);
  drop_unused_vertices(mesh);
}

}  // namespace knotlight
