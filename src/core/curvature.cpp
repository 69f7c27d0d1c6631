#include "core/curvature.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace knotlight {
namespace {

// One step of smoothing (each vertex becomes the mean of itself and its neighbours) spreads a value
// by about 0.6 edges; more steps than this are for meshes whose edges are far below the scale, and
// leave them a little less smooth.
constexpr double spread_per_step = 0.6;
constexpr int most_steps = 400;
// Half the angle by which the surface bends at an edge times its length is the integral of the mean
// curvature there; the ends get half of it each [CM03].
struct Edge {
  std::uint32_t from, to;  // from < to
  std::uint32_t triangle;
};

std::vector<Edge> edges_of(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t i = mesh.triangles[t][corner];
      const std::uint32_t j = mesh.triangles[t][(corner + 1) % 3];
      edges.push_back({std::min(i, j), std::max(i, j), t});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to, a.triangle) < std::tie(b.from, b.to, b.triangle);
  });
  return edges;
}

// The angle by which the surface turns from one triangle to the other, positive at a ridge.
double bend_angle(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const Vec3 n = mesh.normal(a);
  const Vec3 m = mesh.normal(b);
  const Vec3 between = (mesh.corner(b, 0) + mesh.corner(b, 1) + mesh.corner(b, 2) -
                        mesh.corner(a, 0) - mesh.corner(a, 1) - mesh.corner(a, 2));
  const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
  return between.dot(m - n) >= 0.0 ? angle : -angle;
}

double weighted_median(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  const double half = 0.5 * std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0.0;
  for (const std::size_t i : order)
    if ((sum += weights[i]) >= half) return values[i];
  return 0.0;
}

}  // namespace

SurfaceCurvature::SurfaceCurvature(const Shape& shape, double scale)
    : mesh_(std::get_if<TriangleMesh>(&shape)) {
  if (mesh_ == nullptr) {
    median_ = 1.0 / std::get<Sphere>(shape).radius;
    return;
  }
  const std::size_t n = mesh_->vertices.size();
  std::vector<double> curved(n, 0.0);  // integrals around each vertex
  std::vector<double> area(n, 0.0);
  for (std::size_t t = 0; t < mesh_->triangles.size(); ++t)
    for (const std::uint32_t i : mesh_->triangles[t]) area[i] += mesh_->area(t) / 3.0;
  const std::vector<Edge> edges = edges_of(*mesh_);
  double length_of_all = 0.0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double length = (mesh_->vertices[edges[e].to] - mesh_->vertices[edges[e].from]).norm();
    length_of_all += length;
    if (e + 1 == edges.size() || edges[e + 1].from != edges[e].from ||
        edges[e + 1].to != edges[e].to)
      continue;
    const double integral =
        0.5 * length * bend_angle(*mesh_, edges[e].triangle, edges[e + 1].triangle);
    if (!std::isfinite(integral)) continue;  // a triangle without area has no normal
    curved[edges[e].from] += 0.5 * integral;
    curved[edges[e].to] += 0.5 * integral;
  }
  const double edge = length_of_all / static_cast<double>(edges.size());
  const double ratio = scale / (spread_per_step * edge);
  const int steps = static_cast<int>(std::clamp(ratio * ratio, 1.0, double{most_steps}));
  // Integrals of curvature and area are smoothed alike, so that what is concentrated in an edge of
  // a box is spread and not lost.
  const auto smooth = [&](std::vector<double>& values) {
    std::vector<double> sum(n, 0.0);
    std::vector<double> count(n, 0.0);
    for (const Triangle& triangle : mesh_->triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) count[triangle[corner]] += 2.0;
    for (const Triangle& triangle : mesh_->triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        // Half of a vertex's value goes to its neighbours in equal parts.
        const std::uint32_t i = triangle[corner];
        const double share = 0.5 * values[i] / count[i];
        sum[triangle[(corner + 1) % 3]] += share;
        sum[triangle[(corner + 2) % 3]] += share;
      }
    for (std::size_t i = 0; i < n; ++i)
      values[i] = sum[i] + (count[i] > 0.0 ? 0.5 : 1.0) * values[i];
  };
  for (int step = 0; step < steps; ++step) {
    smooth(curved);
    smooth(area);
  }
  at_vertices_.resize(n);
  for (std::size_t i = 0; i < n; ++i) at_vertices_[i] = area[i] > 0.0 ? curved[i] / area[i] : 0.0;
  median_ = weighted_median(at_vertices_, area);
}

double SurfaceCurvature::at(std::uint32_t primitive) const {
  return at(primitive, 1.0 / 3.0, 1.0 / 3.0);
}

double SurfaceCurvature::at(std::uint32_t primitive, double b1, double b2) const {
  if (mesh_ == nullptr) return median_;
  const Triangle& triangle = mesh_->triangles[primitive];
  return (1.0 - b1 - b2) * at_vertices_[triangle[0]] + b1 * at_vertices_[triangle[1]] +
         b2 * at_vertices_[triangle[2]];
}

}  // namespace knotlight
