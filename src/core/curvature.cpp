#include "core/curvature.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace knotlight {
namespace {

// One step of smoothing (each vertex becomes the mean of itself and its neighbours) spreads a value
// by about 0.6 edges; more steps than this are for meshes whose edges are far below the scale, and
// leave them a little less smooth.
constexpr double spread_per_step = 0.6;
constexpr int most_steps = 400;
// Of a corner's angle: below it the triangle is a sliver, whose cotangent says nothing.
constexpr double largest_cotangent = 50.0;

double cotangent(const Vec3& a, const Vec3& b) {
  const double sine = a.cross(b).norm();
  const double cosine = a.dot(b);
  if (std::abs(cosine) >= largest_cotangent * sine)
    return cosine < 0.0 ? -largest_cotangent : largest_cotangent;
  return cosine / sine;
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
  // int H n dA around each vertex = 1/4 sum (cot + cot') (x_i - x_j), its area, its normal.
  std::vector<Vec3> bend(n, Vec3::Zero());
  std::vector<Vec3> normal(n, Vec3::Zero());
  std::vector<double> area(n, 0.0);
  double edges = 0.0;
  for (const Triangle& triangle : mesh_->triangles)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t i = triangle[corner];
      const std::uint32_t j = triangle[(corner + 1) % 3];
      const std::uint32_t k = triangle[(corner + 2) % 3];
      const Vec3 a = mesh_->vertices[i] - mesh_->vertices[k];
      const Vec3 b = mesh_->vertices[j] - mesh_->vertices[k];
      const Vec3 part = 0.25 * cotangent(a, b) * (a - b);  // edge i-j, opposite to k
      bend[i] += part;
      bend[j] -= part;
      const Vec3 doubled = a.cross(b);
      normal[i] += doubled;
      area[i] += doubled.norm() / 6.0;
      edges += (a - b).norm();
    }
  const double edge = edges / (3.0 * static_cast<double>(mesh_->triangles.size()));
  const double ratio = scale / (spread_per_step * edge);
  const int steps = static_cast<int>(std::clamp(ratio * ratio, 1.0, double{most_steps}));
  std::vector<double> curved(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double length = normal[i].norm();
    curved[i] = length > 0.0 ? bend[i].dot(normal[i]) / length : 0.0;
  }
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
