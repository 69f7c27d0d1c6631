#include "core/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sampling.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Fractional parts of its multiples fill (0, 1) more evenly than those of any other number.
constexpr double golden_ratio = std::numbers::phi;

// The two coordinates of stratum `index`: where in the stratum, and across it.
Eigen::Vector2d within_stratum(std::size_t index, bool jitter, std::uint64_t seed, Stream purpose) {
  if (!jitter) return {0.5, 0.5};
  Rng rng(seed, purpose, index);
  const double u = rng.uniform();
  return {u, rng.uniform()};
}

// Bands of z, in proportion to the number of their cells (area is proportional to height on a
// sphere), each cut into cells of equal phi; every other band is turned by half a cell, so that
// cells do not line up along meridians.
std::vector<SurfacePoint> sphere_points(const Sphere& sphere, std::size_t count, bool jitter,
                                        std::uint64_t seed, Stream purpose) {
  std::vector<SurfacePoint> points;
  points.reserve(count);
  const double n = static_cast<double>(count);
  const auto bands =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(std::sqrt(0.5 * n))));
  for (std::size_t band = 0; band < bands; ++band) {
    const std::size_t first = count * band / bands;
    const std::size_t cells = count * (band + 1) / bands - first;
    const double z_lo = 2.0 * static_cast<double>(first) / n - 1.0;
    const double height = 2.0 * static_cast<double>(cells) / n;
    const double turn = band % 2 == 0 ? 0.0 : 0.5;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const Eigen::Vector2d u = within_stratum(first + cell, jitter, seed, purpose);
      const double z = z_lo + height * u.x();
      const double phi =
          2.0 * pi * (static_cast<double>(cell) + u.y() + turn) / static_cast<double>(cells);
      const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
      const Vec3 normal(s * std::cos(phi), s * std::sin(phi), z);
      points.push_back({sphere.center + sphere.radius * normal, normal});
    }
  }
  return points;
}

// Spreads the lowest 21 bits of x to every third bit.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffffULL;
  x = (x | x << 32U) & 0x1f00000000ffffULL;
  x = (x | x << 16U) & 0x1f0000ff0000ffULL;
  x = (x | x << 8U) & 0x100f00f00f00f00fULL;
  x = (x | x << 4U) & 0x10c30c30c30c30c3ULL;
  x = (x | x << 2U) & 0x1249249249249249ULL;
  return x;
}

// A stratum is a run of the cumulative area along the Morton curve. Its position along the run
// picks the triangle, and the remainder is the first coordinate in it, so that strata smaller than
// a triangle are strips of it; the second is random, or follows the golden ratio so that centres
// of consecutive strips do not line up.
std::vector<SurfacePoint> mesh_points(const TriangleMesh& mesh, std::size_t count, bool jitter,
                                      std::uint64_t seed, Stream purpose) {
  const std::vector<std::uint32_t> order = morton_order(mesh);
  std::vector<double> area_up_to;  // including triangle order[i]
  area_up_to.reserve(order.size());
  double total = 0.0;
  for (const std::uint32_t t : order) area_up_to.push_back(total += mesh.area(t));
  std::vector<SurfacePoint> points;
  if (order.empty()) return points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d u = within_stratum(i, jitter, seed, purpose);
    const double target = total * ((static_cast<double>(i) + u.x()) / static_cast<double>(count));
    const auto above = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, target);
    const auto k = static_cast<std::size_t>(above - area_up_to.begin());
    const std::uint32_t t = order[k];
    const double before = k > 0 ? area_up_to[k - 1] : 0.0;
    const double remainder = std::clamp((target - before) / (*above - before), 0.0, 1.0);
    const double across =
        jitter ? u.y() : std::fmod(golden_ratio * (static_cast<double>(i) + 0.5), 1.0);
    const Eigen::Vector2d b = sample_triangle(remainder, across);
    points.push_back({(1.0 - b.x() - b.y()) * mesh.corner(t, 0) + b.x() * mesh.corner(t, 1) +
                          b.y() * mesh.corner(t, 2),
                      mesh.normal(t)});
  }
  return points;
}

}  // namespace

std::vector<std::uint32_t> morton_order(const TriangleMesh& mesh) {
  constexpr double cells = 2097151.0;  // 2^21 - 1 per axis
  const Bounds box = bounds(mesh);
  const double extent = box.largest_extent();
  const double scale = extent > 0.0 ? cells / extent : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> codes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!(mesh.area(t) > 0.0)) continue;
    const Vec3 centroid = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    const Vec3 q = scale * (centroid - box.lo);
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
      code |= spread_bits(static_cast<std::uint64_t>(std::clamp(q[axis], 0.0, cells))) << axis;
    codes.emplace_back(code, static_cast<std::uint32_t>(t));
  }
  std::sort(codes.begin(), codes.end());
  std::vector<std::uint32_t> order;
  order.reserve(codes.size());
  for (const auto& [code, triangle] : codes) order.push_back(triangle);
  return order;
}

Bounds bounds(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return bounds(*mesh);
  const auto& sphere = std::get<Sphere>(shape);
  return {sphere.center - Vec3::Constant(sphere.radius),
          sphere.center + Vec3::Constant(sphere.radius)};
}

Sphere sphere_around(const std::vector<const Shape*>& shapes) {
  Bounds box;
  for (const Shape* shape : shapes) {
    const Bounds own = bounds(*shape);
    box.extend(own.lo);
    box.extend(own.hi);
  }
  Sphere around{box.center(), 0.0};
  for (const Shape* shape : shapes) {
    if (const auto* sphere = std::get_if<Sphere>(shape)) {
      around.radius =
          std::max(around.radius, (sphere->center - around.center).norm() + sphere->radius);
    } else {
      for (const Vec3& vertex : std::get<TriangleMesh>(*shape).vertices)
        around.radius = std::max(around.radius, (vertex - around.center).norm());
    }
  }
  return around;
}

double surface_area(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return surface_area(*mesh);
  const double r = std::get<Sphere>(shape).radius;
  return 4.0 * pi * r * r;
}

double volume(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return signed_volume(*mesh);
  const double r = std::get<Sphere>(shape).radius;
  return 4.0 / 3.0 * pi * r * r * r;
}

SurfaceSamples columns(const std::vector<SurfacePoint>& points) {
  const auto n = static_cast<Eigen::Index>(points.size());
  SurfaceSamples samples{Points(3, n), Points(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    samples.positions.col(i) = points[static_cast<std::size_t>(i)].position;
    samples.normals.col(i) = points[static_cast<std::size_t>(i)].normal;
  }
  return samples;
}

std::vector<SurfacePoint> stratified_surface_points(const Shape& shape, std::size_t count,
                                                    bool jitter, std::uint64_t seed,
                                                    Stream purpose) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    return mesh_points(*mesh, count, jitter, seed, purpose);
  return sphere_points(std::get<Sphere>(shape), count, jitter, seed, purpose);
}

}  // namespace knotlight
