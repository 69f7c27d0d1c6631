#include "bkm/knots.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace knotlight {
namespace {

// Random points per knot of blue noise: with more the smallest distance grows by a per cent or two.
constexpr std::size_t candidates_per_knot = 16;

SurfaceSamples thinned(const SurfaceSamples& knots, std::size_t count) {
  if (static_cast<std::size_t>(knots.positions.cols()) <= count) return knots;
  const std::vector<Eigen::Index> kept = farthest_points(knots.positions, count);
  return {knots.positions(Eigen::all, kept), knots.normals(Eigen::all, kept)};
}

// Every vertex that a triangle uses, once, with its smooth normal.
SurfaceSamples mesh_vertices(const TriangleMesh& mesh) {
  constexpr double all_facets = -1.0;  // cosine that no edge is sharper than
  const std::vector<Vec3> corner_normals = smooth_corner_normals(mesh, all_facets);
  std::vector<bool> used(mesh.vertices.size(), false);
  std::vector<SurfacePoint> points;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh.triangles[t][static_cast<std::size_t>(i)];
      if (used[vertex]) continue;
      used[vertex] = true;
      points.push_back(
          {mesh.vertices[vertex], corner_normals[3 * t + static_cast<std::size_t>(i)]});
    }
  return columns(points);
}

// Directions to the vertices of an icosahedron whose facets are divided n x n: corner weights
// (i, j, n - i - j) / n. Points that facets share are told apart by the corners that have weight.
std::vector<Vec3> icosahedron_directions(int n) {
  const double g = std::numbers::phi;
  std::vector<Vec3> corners;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) {
      corners.emplace_back(0.0, a, b);
      corners.emplace_back(a, b, 0.0);
      corners.emplace_back(b, 0.0, a);
    }
  std::map<std::array<int, 12>, Vec3> points;  // by the weights of all corners
  const auto neighbours = [&](int p, int q) {
    constexpr double just_over_edge = 2.1;  // edges have length 2, diagonals 2 phi and more
    return (corners[static_cast<std::size_t>(p)] - corners[static_cast<std::size_t>(q)]).norm() <
           just_over_edge;
  };
  for (int p = 0; p < 12; ++p)
    for (int q = p + 1; q < 12; ++q)
      for (int r = q + 1; r < 12; ++r) {
        if (!neighbours(p, q) || !neighbours(q, r) || !neighbours(p, r)) continue;
        for (int i = 0; i <= n; ++i)
          for (int j = 0; i + j <= n; ++j) {
            std::array<int, 12> weights{};
            Vec3 x = Vec3::Zero();
            for (const auto& [corner, weight] : {std::pair{p, i}, {q, j}, {r, n - i - j}}) {
              weights[static_cast<std::size_t>(corner)] = weight;
              x += weight * corners[static_cast<std::size_t>(corner)];
            }
            points.emplace(weights, x.normalized());
          }
      }
  std::vector<Vec3> directions;
  for (const auto& [weights, x] : points) directions.push_back(x);
  return directions;
}

SurfaceSamples sphere_vertices(const Sphere& sphere, std::size_t count) {
  const double exact = std::sqrt((static_cast<double>(count) - 2.0) / 10.0);
  const auto vertices = [](double n) { return 10.0 * n * n + 2.0; };
  double n = std::max(1.0, std::floor(exact));
  const double half_way = 0.5 * (vertices(n) + vertices(n + 1.0));
  if (static_cast<double>(count) > half_way) n += 1.0;
  std::vector<SurfacePoint> points;
  for (const Vec3& d : icosahedron_directions(static_cast<int>(n)))
    points.push_back({sphere.center + sphere.radius * d, d});
  return columns(points);
}

}  // namespace

SurfaceSamples surface_knots(const Shape& shape, KnotLayout layout, std::size_t count,
                             std::uint64_t seed) {
  switch (layout) {
    case KnotLayout::vertices:
      if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
        return thinned(mesh_vertices(*mesh), count);
      return sphere_vertices(std::get<Sphere>(shape), count);
    case KnotLayout::blue_noise:
      return thinned(columns(stratified_surface_points(shape, candidates_per_knot * count, true,
                                                       seed, Stream::boundary_knots)),
                     count);
    case KnotLayout::stratified:
    case KnotLayout::jittered:
      break;
  }
  return columns(stratified_surface_points(shape, count, layout == KnotLayout::jittered, seed,
                                           Stream::boundary_knots));
}

std::vector<Eigen::Index> farthest_points(const Points& points, std::size_t count) {
  assert(count <= static_cast<std::size_t>(points.cols()));
  std::vector<Eigen::Index> chosen;
  Eigen::RowVectorXd distance =  // squared, to the nearest of those chosen
      Eigen::RowVectorXd::Constant(points.cols(), std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  while (chosen.size() < count) {
    chosen.push_back(next);
    distance = distance.cwiseMin((points.colwise() - points.col(next)).colwise().squaredNorm());
    distance.maxCoeff(&next);
  }
  return chosen;
}

std::vector<double> layer_depths(InteriorLayout layout) {
  switch (layout) {
    case InteriorLayout::one_layer:
      return {1.5};
    case InteriorLayout::near_layers:
      return {0.5, 1.5};
    case InteriorLayout::two_layers:
      return {1.0, 1.5};
    case InteriorLayout::none:
    case InteriorLayout::grid:
      break;
  }
  return {};
}

InteriorKnots interior_knots(const Points& boundary_points, const Points& boundary_normals,
                             const std::vector<double>& depths,
                             const std::function<bool(const Vec3&)>& inside) {
  assert(boundary_points.cols() == boundary_normals.cols());
  const Eigen::Index count = boundary_points.cols();
  Points kept(3, count * static_cast<Eigen::Index>(depths.size()));
  InteriorKnots knots;
  Eigen::Index used = 0;
  for (const double depth : depths)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vec3 candidate = boundary_points.col(i) - depth * boundary_normals.col(i);
      if (inside(candidate))
        kept.col(used++) = candidate;
      else
        ++knots.dropped;
    }
  knots.points = kept.leftCols(used);
  return knots;
}

InteriorKnots grid_knots(const Points& boundary_points, double volume, std::size_t count,
                         const std::function<bool(const Vec3&)>& inside) {
  assert(boundary_points.cols() > 0 && volume > 0.0 && count > 0);
  const double h = std::cbrt(volume / static_cast<double>(count));
  const Vec3 lo = boundary_points.rowwise().minCoeff(), hi = boundary_points.rowwise().maxCoeff();
  const Eigen::Array3i cells = ((hi - lo).array() / h).ceil().cast<int>().max(1);
  // The lattice is centred in the box.
  const Vec3 first = 0.5 * (lo + hi) - 0.5 * h * (cells - 1).cast<double>().matrix();
  InteriorKnots knots;
  std::vector<Vec3> kept;
  for (int i = 0; i < cells.x(); ++i)
    for (int j = 0; j < cells.y(); ++j)
      for (int l = 0; l < cells.z(); ++l) {
        const Vec3 x = first + h * Vec3(i, j, l);
        const double nearest = (boundary_points.colwise() - x).colwise().squaredNorm().minCoeff();
        if (nearest >= 0.25 * h * h && inside(x))
          kept.push_back(x);
        else
          ++knots.dropped;
      }
  knots.points.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i)
    knots.points.col(static_cast<Eigen::Index>(i)) = kept[i];
  return knots;
}

double mean_knot_spacing(double area, std::size_t knots) {
  assert(knots > 0);
  return std::sqrt(area / static_cast<double>(knots));
}

}  // namespace knotlight
