#include "support/test_meshes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>

namespace knotlight::test {

using std::numbers::pi;

TriangleMesh icosphere(int levels, const Vec3& center, double radius) {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
      const auto [entry, is_new] = midpoints.emplace(std::minmax(a, b), next);
      if (is_new) mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const std::uint32_t ab = midpoint(t[0], t[1]);
      const std::uint32_t bc = midpoint(t[1], t[2]);
      const std::uint32_t ca = midpoint(t[2], t[0]);
      finer.insert(finer.end(), {Triangle{t[0], ab, ca}, Triangle{ab, t[1], bc},
                                 Triangle{ca, bc, t[2]}, Triangle{ab, bc, ca}});
    }
    mesh.triangles = finer;
    for (Vec3& v : mesh.vertices) v.normalize();
  }
  for (Vec3& v : mesh.vertices) v = center + radius * v.normalized();
  return mesh;
}

TriangleMesh torus_mesh(double major_radius, double minor_radius, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * pi * i / around;
      const double v = 2.0 * pi * j / across;
      const double r = major_radius + minor_radius * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i % around * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh twisted_strip(int around, int half_turns) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double u = 2.0 * pi * i / around;
    const Vec3 outward(std::cos(u), std::sin(u), 0.0);
    const double tilt = 0.5 * half_turns * u;
    const Vec3 across = std::cos(tilt) * Vec3::UnitZ() + std::sin(tilt) * outward;
    mesh.vertices.push_back(outward - 0.3 * across);
    mesh.vertices.push_back(outward + 0.3 * across);
  }
  const auto at = [&](int i, int side) {
    const bool swapped = i == around && half_turns % 2 != 0;
    return static_cast<std::uint32_t>(2 * (i % around) + (swapped ? 1 - side : side));
  };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
    mesh.triangles.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
  }
  return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles)
    both.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return both;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh triangle_soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (int i = 0; i < 3; ++i) soup.vertices.push_back(mesh.corner(t, i));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TriangleMesh without_triangle(TriangleMesh mesh, std::size_t triangle) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
  return mesh;
}

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> find_open_edges(const TriangleMesh& mesh) {
  struct Uses {
    int forward = 0, backward = 0;
  };
  std::map<Edge, Uses> uses;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      Uses& edge = uses[std::minmax(a, b)];
      ++(a < b ? edge.forward : edge.backward);
    }
  }
  std::vector<Edge> open;
  for (const auto& [edge, use] : uses)
    if (use.forward != 1 || use.backward != 1) open.push_back(edge);
  return open;
}

}  // namespace

std::size_t open_edges(const TriangleMesh& mesh) {
  return find_open_edges(mesh).size();
}

double length_of_open_edges(const TriangleMesh& mesh) {
  double length = 0.0;
  for (const auto& [a, b] : find_open_edges(mesh))
    length += (mesh.vertices[a] - mesh.vertices[b]).norm();
  return length;
}

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, (mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i)).norm());
  return longest;
}

TemporaryFile::TemporaryFile(const std::string& extension, const std::string& content) {
  static int number = 0;
  path_ = std::filesystem::temp_directory_path() /
          fmt::format("knotlight-test-{}-{}{}", getpid(), number++, extension);
  std::ofstream file(path_, std::ios::binary);
  file << content;
  if (!file.flush()) throw std::runtime_error("cannot write " + path_.string());
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::string as_obj(const TriangleMesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const Triangle& t : mesh.triangles)
    text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string as_text_stl(const TriangleMesh& mesh) {
  std::string text = "solid test\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 n = mesh.normal(t);
    text += fmt::format("facet normal {} {} {}\n outer loop\n", n.x(), n.y(), n.z());
    for (int i = 0; i < 3; ++i) {
      const Vec3& v = mesh.corner(t, i);
      text += fmt::format("  vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid test\n";
}

std::string as_binary_stl(const TriangleMesh& mesh) {
  std::string data(80, ' ');
  const auto append = [&data](const auto& value) {
    data.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const double x : Vec3(mesh.normal(t))) append(static_cast<float>(x));
    for (int i = 0; i < 3; ++i)
      for (const double x : mesh.corner(t, i)) append(static_cast<float>(x));
    append(std::uint16_t{0});
  }
  return data;
}

std::string as_text_ply(const TriangleMesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const Triangle& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace knotlight::test
