// Triangles that cross each other: candidates from a tree of bounding boxes, each pair judged by
// the intervals that the triangles cover on the line common to their planes (Moller 1997 [M97]).
#include <algorithm>
#include <numeric>
#include <optional>

#include "scene/mesh_reader.h"
#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

constexpr std::size_t leaf_size = 4;  // box tests cost about as much as descending further

bool boxes_meet(const Bounds& a, const Bounds& b) {
  return (a.lo.array() <= b.hi.array()).all() && (b.lo.array() <= a.hi.array()).all();
}

// Bounding boxes of runs of `order`, halved at the median until they are leaves.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    if (!order_.empty()) build(0, order_.size());
  }
  const Bounds& box(std::size_t i) const { return boxes_[i]; }

  // Calls visit(i) for every box that meets `box` until it returns true.
  template <class Visit>
  bool for_meeting(const Bounds& box, const Visit& visit, std::size_t node = 0) const {
    const Node& n = nodes_[node];
    if (!boxes_meet(n.box, box)) return false;
    if (n.right == 0) {
      for (std::size_t k = n.begin; k < n.end; ++k)
        if (boxes_meet(boxes_[order_[k]], box) && visit(order_[k])) return true;
      return false;
    }
    return for_meeting(box, visit, node + 1) || for_meeting(box, visit, n.right);
  }

 private:
  struct Node {
    Bounds box;
    std::size_t begin, end;
    std::size_t right = 0;  // the left child follows its parent; 0 for leaves
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({{}, begin, end});
    Bounds box;
    Bounds centers;
    for (std::size_t k = begin; k < end; ++k) {
      box.extend(boxes_[order_[k]].lo);
      box.extend(boxes_[order_[k]].hi);
      centers.extend(boxes_[order_[k]].center());
    }
    nodes_[node].box = box;
    if (end - begin <= leaf_size) return node;
    Eigen::Index axis = 0;
    (centers.hi - centers.lo).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = order_.begin();
    std::nth_element(
        first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
        first + static_cast<std::ptrdiff_t>(end), [&](std::uint32_t a, std::uint32_t b) {
          return boxes_[a].center()[axis] < boxes_[b].center()[axis];
        });
    build(begin, middle);
    nodes_[node].right = build(middle, end);
    return node;
  }

  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

struct Interval {
  double lo, hi;
};

// Heights of the corners of `triangle` over the plane; within `tolerance` counts as on it. Nothing
// if no corner is above or none below: then the triangle does not go through the plane.
std::optional<Vec3> heights_if_through(const Eigen::Matrix3d& triangle, const Vec3& on_plane,
                                       const Vec3& normal, double tolerance) {
  Vec3 heights = (triangle.colwise() - on_plane).transpose() * normal;
  for (double& h : heights)
    if (std::abs(h) <= tolerance) h = 0.0;
  if (heights.minCoeff() < 0.0 && heights.maxCoeff() > 0.0) return heights;
  return std::nullopt;
}

// The part of the line along `direction` that the triangle covers where it goes through the plane.
Interval covered(const Eigen::Matrix3d& triangle, const Vec3& heights, const Vec3& direction) {
  Interval interval{1e300, -1e300};
  const auto extend = [&](const Vec3& p) {
    const double s = p.dot(direction);
    interval.lo = std::min(interval.lo, s);
    interval.hi = std::max(interval.hi, s);
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (heights[i] == 0.0) extend(triangle.col(i));
    if (heights[i] * heights[j] < 0.0)
      extend(triangle.col(i) +
             heights[i] / (heights[i] - heights[j]) * (triangle.col(j) - triangle.col(i)));
  }
  return interval;
}

// Do they cross by more than the tolerance? Touching, and lying in one plane, is not crossing.
bool cross(const Eigen::Matrix3d& a, const Vec3& normal_a, const Eigen::Matrix3d& b,
           const Vec3& normal_b, double tolerance) {
  const auto heights_b = heights_if_through(b, a.col(0), normal_a, tolerance);
  if (!heights_b) return false;
  const auto heights_a = heights_if_through(a, b.col(0), normal_b, tolerance);
  if (!heights_a) return false;
  const Vec3 direction = normal_a.cross(normal_b).normalized();
  const Interval on_a = covered(a, *heights_a, direction);
  const Interval on_b = covered(b, *heights_b, direction);
  return std::min(on_a.hi, on_b.hi) - std::max(on_a.lo, on_b.lo) > tolerance;
}

bool share_a_vertex(const Triangle& a, const Triangle& b) {
  for (const std::uint32_t v : a)
    if (v == b[0] || v == b[1] || v == b[2]) return true;
  return false;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> intersecting_triangles(const TriangleMesh& mesh,
                                                                        std::size_t limit) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (mesh.triangles.empty() || limit == 0) return pairs;
  // About the middle of the mesh, so that no digits go into its position.
  const Bounds all = bounds(mesh);
  const double tolerance = same_position_fraction * all.largest_extent();
  std::vector<Eigen::Matrix3d> corners(mesh.triangles.size());
  std::vector<Vec3> normals(mesh.triangles.size());
  std::vector<Bounds> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      corners[t].col(i) = mesh.corner(t, i) - all.center();
      boxes[t].extend(corners[t].col(i));
    }
    normals[t] = mesh.normal(t);
  }
  const BoxTree tree(std::move(boxes));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool is_full = tree.for_meeting(tree.box(t), [&](std::size_t other) {
      if (other > t && !share_a_vertex(mesh.triangles[t], mesh.triangles[other]) &&
          cross(corners[t], normals[t], corners[other], normals[other], tolerance)) {
        pairs.emplace_back(t, other);
      }
      return pairs.size() == limit;
    });
    if (is_full) break;
  }
  return pairs;
}

}  // namespace knotlight
