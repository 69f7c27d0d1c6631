// Makes the torus of the scenes, radii 1 and 0.35, as a closed triangle mesh in a binary PLY file.
// Usage: make_torus torus.ply
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/mesh.h"
#include "core/ply_writer.h"

int main(int argc, char** argv) {
  using namespace knotlight;
  using std::numbers::pi;
  if (argc != 2) {
    fmt::print(stderr, "usage: make_torus torus.ply\n");
    return 2;
  }
  constexpr int around = 160, across = 56;
  constexpr double R = 1.0, r = 0.35;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * pi * i / around, v = 2.0 * pi * j / across;
      const double rho = R + r * std::cos(v);
      mesh.vertices.emplace_back(rho * std::cos(u), rho * std::sin(u), r * std::sin(v));
      const auto at = [](int a, int b) {
        return static_cast<std::uint32_t>(a % around * across + b % across);
      };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  write_ply(argv[1], mesh, "torus by make_torus");
}
