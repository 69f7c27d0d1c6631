#include "meshes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

#include "scene/mesh_reader.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// A cube of 6 n^2 squares of two triangles, blown up to r(direction).
TriangleMesh blown_up_cube(int n, const std::function<double(const Vec3&)>& r) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> index_of;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, added] =
        index_of.emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added) {
      // Equal angles rather than equal steps: squares of nearly one size.
      const auto place = [n](int i) { return std::tan(0.25 * pi * (2.0 * i / n - 1.0)); };
      const Vec3 direction = Vec3(place(at[0]), place(at[1]), place(at[2])).normalized();
      mesh.vertices.push_back(r(direction) * direction);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = side;
            // The other two axes in cyclic order, swapped on the near side: outward everywhere.
            at[(axis + (side == n ? 1 : 2)) % 3] = i + di;
            at[(axis + (side == n ? 2 : 1)) % 3] = j + dj;
            return vertex(at);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                              d = corner(0, 1);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
  return mesh;
}

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, (mesh.corner(t, i) - mesh.corner(t, (i + 1) % 3)).norm());
  return longest;
}

}  // namespace

TriangleMesh torus_mesh() {
  constexpr int around = 160, across = 56;
  constexpr double R = 1.0, r = 0.35;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * pi * i / around, v = 2.0 * pi * j / across;
      const double rho = R + r * std::cos(v);
      mesh.vertices.emplace_back(rho * std::cos(u), rho * std::sin(u), r * std::sin(v));
    }
  const auto at = [](int i, int j) {
    return static_cast<std::uint32_t>(i % around * across + j % across);
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

TriangleMesh bumpy_mesh() {
  constexpr int squares = 9;  // along an edge of the cube
  return blown_up_cube(squares, [](const Vec3& d) {
    return 1.0 + 0.1 * std::cos(5.0 * d.x()) * std::cos(4.0 * d.y()) * std::cos(3.0 * d.z());
  });
}

TriangleMesh rippled_mesh(std::size_t triangles) {
  constexpr double edges_per_wave = 12.0, height_per_wave = 0.1;
  const int n =
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(triangles) / 12.0)));  // 2 x 6 n^2
  const double wave = edges_per_wave * 0.5 * pi / n;
  const double k = 2.0 * pi / wave;
  return blown_up_cube(n, [=](const Vec3& d) {
    return 1.0 +
           height_per_wave * wave * std::sin(k * d.x()) * std::sin(k * d.y()) * std::sin(k * d.z());
  });
}

TriangleMesh refined_to(TriangleMesh mesh, std::size_t triangles) {
  constexpr double step = 0.93;  // of the longest edge: about 15 % more triangles at a time
  double edge = longest_edge(mesh);
  while (mesh.triangles.size() < triangles) mesh = refine(std::move(mesh), edge *= step);
  return mesh;
}

TriangleMesh mended_bunny(const std::string& obj) {
  if (!std::filesystem::exists(obj))
    throw std::runtime_error(obj + " is not there: ./knotlight info scenes/bunny.yaml fetches it");
  TriangleMesh mesh = read_mesh(obj);
  // From, to: the corners of the crossing triangles, half way to the mean of their neighbours.
  const std::array<std::pair<Vec3, Vec3>, 5> moves{{
      {{-0.480485, -0.677153, 0.274209}, {-0.481298, -0.6772915, 0.2713135}},
      {{-0.484981, -0.675714, 0.271678}, {-0.4815875, -0.67841367, 0.2654675}},
      {{-0.463413, -0.68739, 0.265564}, {-0.4705809, -0.6835405, 0.2658683}},
      {{-0.4908, -0.672695, 0.279398}, {-0.493099, -0.6701197, 0.2802304}},
      {{-0.490684, -0.678797, 0.237998}, {-0.49068255, -0.6787993, 0.23799725}},
  }};
  constexpr double same = 1e-6;  // single precision in a model of size 2; neighbours are 5e-3 apart
  for (const auto& [from, to] : moves) {
    int moved = 0;
    for (Vec3& v : mesh.vertices)
      if ((v - from).norm() < same) {
        v = to;
        ++moved;
      }
    if (moved != 1) throw std::runtime_error(obj + " is not the bunny that the bars know");
  }
  return mesh;
}

}  // namespace knotlight
