#include "pipeline/tangent_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>

namespace knotlight {
namespace {

// Facets that meet at less than 45 degrees are parts of one curved surface, as in pictures.
constexpr double crease_cosine = 0.7;
// Facets with an edge longer than this, in k, are seen as what they are: flat.
constexpr double longest_smooth_edge = 3.0;

// The Robin image of a charge on the surface reaches 3.8 k out; deeper charges are mirrored further
// out, but few are deeper than 4 k.
constexpr double reach = 8.0;
// Lower than this, in k, facets are flat and nothing stands in the way.
constexpr double lowest = 0.05;
// An image charge may come as near to the surface as this share of its height: its field there then
// varies over lengths not much smaller than around its foot.
constexpr double nearest_share = 1.0 / 3.0;
// A ball that touches the plane from outside is free of the surface if that comes no nearer to its
// centre than this share of its radius; the rest allows for normals that are not the facets'.
constexpr double ball_share = 0.9;
// Image charges between two walls stay clear of the opposite one: in the nearer part of the gap.
constexpr double roof_share = 0.5;
// Steps smaller than this share of the height mean that the way ends here.
constexpr double least_step = 0.02;
// Planes within a cell of this size, in k, share a height, and are content with less of it.
constexpr double cell = 0.5;
constexpr double shared_share = 0.75;
// With less room than this, in extents of a cell's planes, heights change within it: each plane is
// asked for its own.
constexpr double narrow = 2.0;

constexpr std::size_t cells_per_chunk = 512;  // about a millisecond of searching

struct CellKey {
  std::uint32_t primitive;
  std::array<std::int64_t, 3> place;
  std::size_t index;

  // clang-tidy 14 takes the 0 that <=> is compared with for a pointer.
  auto operator<=>(const CellKey&) const = default;  // NOLINT(modernize-use-nullptr)
  bool same_cell(const CellKey& other) const {
    return primitive == other.primitive && place == other.place;
  }
};

}  // namespace

TangentPlanes::TangentPlanes(const Shape& shape, const RayCaster& caster, std::uint32_t object,
                             double k)
    : shape_(shape), caster_(caster), object_(object), k_(k) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    corner_normals_ = smooth_corner_normals(*mesh, crease_cosine);
}

TangentPlane TangentPlanes::nearest_to(const Vec3& p) const {
  const NearestPoint nearest = *caster_.nearest_point(p, object_);
  TangentPlane plane{nearest.surface.position, nearest.surface.normal, nearest.primitive};
  const auto* mesh = std::get_if<TriangleMesh>(&shape_);
  if (mesh == nullptr) return plane;
  const Vec3& a = mesh->corner(plane.primitive, 0);
  const Vec3& b = mesh->corner(plane.primitive, 1);
  const Vec3& c = mesh->corner(plane.primitive, 2);
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  if (longest > longest_smooth_edge * k_) return plane;
  const Vec3 area = (b - a).cross(c - a);
  const double weight_b = (plane.point - a).cross(c - a).dot(area) / area.squaredNorm();
  const double weight_c = (b - a).cross(plane.point - a).dot(area) / area.squaredNorm();
  const Vec3* n = &corner_normals_[3 * std::size_t{plane.primitive}];
  const Vec3 normal = (1.0 - weight_b - weight_c) * n[0] + weight_b * n[1] + weight_c * n[2];
  // A needle without area, or normals that cancel: the facet's own will do.
  if (normal.norm() > 0.1) plane.normal = normal.normalized();
  return plane;
}

double TangentPlanes::clear_height(const TangentPlane& plane) const {
  const auto distance = [&](double height, double most) {
    const auto nearest = caster_.nearest_point(plane.point + height * plane.normal, object_, most);
    return nearest ? nearest->distance : most;
  };
  // Not through an opposite wall: beyond it distances would grow again, inside the body.
  const auto wall = caster_.nearest({plane.point, plane.normal, reach * k_}, object_);
  const double top = wall ? roof_share * wall->t : reach * k_;
  if (top < lowest * k_) return top;
  // On a convex body one search will do.
  if (distance(top, ball_share * top) == ball_share * top) return top;
  // Upwards, each time as far as the distance found says that it is safe to go.
  double height = lowest * k_;
  double clear = lowest * k_;
  while (height < top) {
    const double free = distance(height, height);
    if (free < nearest_share * height) return clear;
    clear = height;
    height = (free + height) / (1.0 + nearest_share);
    if (height < (1.0 + least_step) * clear) return clear;
  }
  return top;
}

std::vector<double> TangentPlanes::clear_heights(const std::vector<TangentPlane>& planes,
                                                 const Workers& workers) const {
  std::vector<double> heights(planes.size(), reach * k_);
  if (std::holds_alternative<Sphere>(shape_)) return heights;
  std::vector<CellKey> keys(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Vec3 place = planes[i].point / (cell * k_);
    keys[i] = {planes[i].primitive,
               {std::llround(place.x()), std::llround(place.y()), std::llround(place.z())},
               i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> first_of_cell;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (i == 0 || !keys[i].same_cell(keys[i - 1])) first_of_cell.push_back(i);
  first_of_cell.push_back(keys.size());
  workers.for_chunks(first_of_cell.size() - 1, cells_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (std::size_t c = begin; c < end; ++c) {
                         const std::size_t first = first_of_cell[c];
                         const TangentPlane& plane = planes[keys[first].index];
                         const double own = clear_height(plane);
                         const double height = own < reach * k_ ? shared_share * own : own;
                         double extent = 0.0;
                         for (std::size_t i = first; i < first_of_cell[c + 1]; ++i)
                           extent =
                               std::max(extent, (planes[keys[i].index].point - plane.point).norm());
                         for (std::size_t i = first; i < first_of_cell[c + 1]; ++i)
                           heights[keys[i].index] =
                               own < narrow * extent ? clear_height(planes[keys[i].index]) : height;
                       }
                     });
  return heights;
}

}  // namespace knotlight
