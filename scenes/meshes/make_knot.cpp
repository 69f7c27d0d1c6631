// Makes the trefoil knot of the scenes: a round tube around
//   c(t) = s (sin t + 2 sin 2t, cos t - 2 cos 2t, -h sin 3t),  0 <= t < 2 pi,
// as a closed triangle mesh in a binary PLY file. Usage: make_knot knot.ply
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/ply_writer.h"

namespace {

using knotlight::TriangleMesh;
using knotlight::Vec3;
using std::numbers::pi;

constexpr double scale = 0.49;          // s; the knot is then 3.3 wide
constexpr double height = 1.25;         // h
constexpr double tube_radius = 0.30;    // length, in the units of the scenes
constexpr int across = 38;              // vertices around the tube
constexpr int curve_samples = 20000;    // for the arc length; chords then err by 1e-7
constexpr double least_distance = 2.2;  // between strands, in tube radii; 2 would be touching

Vec3 curve(double t) {
  return scale * Vec3(std::sin(t) + 2.0 * std::sin(2.0 * t), std::cos(t) - 2.0 * std::cos(2.0 * t),
                      -height * std::sin(3.0 * t));
}

Vec3 tangent(double t) {
  return Vec3(std::cos(t) + 4.0 * std::cos(2.0 * t), -std::sin(t) + 4.0 * std::sin(2.0 * t),
              -3.0 * height * std::cos(3.0 * t))
      .normalized();
}

// Arc length from 0 to 2 pi i / curve_samples, i = 0 .. curve_samples.
std::vector<double> arc_lengths() {
  std::vector<double> lengths{0.0};
  for (int i = 1; i <= curve_samples; ++i) {
    const double step = 2.0 * pi / curve_samples;
    lengths.push_back(lengths.back() + (curve(i * step) - curve((i - 1) * step)).norm());
  }
  return lengths;
}

// `rings` parameters at equal distances along the curve.
std::vector<double> equidistant_parameters(const std::vector<double>& lengths, int rings) {
  std::vector<double> parameters;
  std::size_t i = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const double target = lengths.back() * ring / rings;
    while (lengths[i + 1] <= target) ++i;
    const double fraction = (target - lengths[i]) / (lengths[i + 1] - lengths[i]);
    parameters.push_back(2.0 * pi * (static_cast<double>(i) + fraction) / curve_samples);
  }
  return parameters;
}

// Reflection in the plane normal to m (not normalised).
Vec3 reflected(const Vec3& v, const Vec3& m) {
  return v - 2.0 * m.dot(v) / m.squaredNorm() * m;
}

// Normals of the curve that turn about it as little as possible: double reflection
// (W. Wang and others, Computation of rotation minimizing frames, ACM Trans. Graph. 27 (2008) 2).
// One more than there are parameters: the last is what comes back to the start.
std::vector<Vec3> transported_normals(const std::vector<double>& parameters) {
  std::vector<Vec3> normals{tangent(parameters[0]).unitOrthogonal()};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double t0 = parameters[i];
    const double t1 = parameters[(i + 1) % parameters.size()];
    const Vec3 step = curve(t1) - curve(t0);
    const Vec3 halfway = reflected(tangent(t0), step);
    normals.push_back(reflected(reflected(normals.back(), step), tangent(t1) - halfway));
  }
  return normals;
}

TriangleMesh tube(const std::vector<double>& parameters) {
  const std::vector<Vec3> normals = transported_normals(parameters);
  const auto rings = static_cast<int>(parameters.size());
  // What the frame lacks after one turn is spread over all rings, so that the seam closes.
  const Vec3 t0 = tangent(parameters[0]);
  const double missing =
      std::atan2(t0.dot(normals.back().cross(normals[0])), normals.back().dot(normals[0]));
  TriangleMesh mesh;
  for (int ring = 0; ring < rings; ++ring) {
    const Vec3 n = normals[static_cast<std::size_t>(ring)];
    const double t = parameters[static_cast<std::size_t>(ring)];
    const Vec3 b = tangent(t).cross(n);
    for (int j = 0; j < across; ++j) {
      const double angle = 2.0 * pi * j / across + missing * ring / rings;
      mesh.vertices.push_back(curve(t) + tube_radius * (std::cos(angle) * n + std::sin(angle) * b));
    }
  }
  const auto at = [&](int ring, int j) {
    return static_cast<std::uint32_t>(ring % rings * across + j % across);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(ring, j), at(ring, j + 1), at(ring + 1, j + 1)});
      mesh.triangles.push_back({at(ring, j), at(ring + 1, j + 1), at(ring + 1, j)});
    }
  }
  return mesh;
}

// The least distance between points of the curve that are further apart along it than half a
// circle of 1.5 tube radii, which keeps neighbours on the same bend out.
double strand_distance(const std::vector<double>& parameters, double length) {
  const std::size_t n = parameters.size();
  const double spacing = length / static_cast<double>(n);
  double least = length;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double along = spacing * static_cast<double>(std::min(j - i, n - (j - i)));
      if (along > 1.5 * pi * tube_radius)
        least = std::min(least, (curve(parameters[i]) - curve(parameters[j])).norm());
    }
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_knot FILE.ply\n");
    return 2;
  }
  try {
    const std::vector<double> lengths = arc_lengths();
    // Rings as far apart as the vertices of a ring: nearly square cells.
    const int rings =
        static_cast<int>(std::lround(lengths.back() / (2.0 * pi * tube_radius / across)));
    const std::vector<double> parameters = equidistant_parameters(lengths, rings);
    const double distance = strand_distance(parameters, lengths.back());
    if (distance < least_distance * tube_radius)
      throw std::runtime_error(fmt::format("strands come as near as {:.3f}", distance));
    TriangleMesh mesh = tube(parameters);
    const Vec3 center = bounds(mesh).center();
    for (Vec3& v : mesh.vertices) v -= center;
    knotlight::write_ply(argv[1], mesh, "trefoil knot by make_knot");
    const Vec3 size = bounds(mesh).hi - bounds(mesh).lo;
    fmt::print(
        "{} vertices, {} triangles, size {:.3f} x {:.3f} x {:.3f}, length {:.4f}, volume "
        "{:.5f}, least distance of strands {:.3f} tube radii\n",
        mesh.vertices.size(), mesh.triangles.size(), size.x(), size.y(), size.z(), lengths.back(),
        signed_volume(mesh), distance / tube_radius);
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_knot: {}\n", error.what());
    return 1;
  }
  return 0;
}
