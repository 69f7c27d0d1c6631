#include "bkm/patch_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace knotlight {
namespace {

constexpr double root_margin = 1e-3;  // of the size: knots on the root's faces count as within
// Tries to see a point from others before it counts as cut off: patches are nearly convex.
constexpr std::size_t most_hubs = 12;
// Leaves whose cube, widened so many times, holds knots count as next to the surface.
constexpr double surface_reach = 3.0;

bool within(const Vec3& x, const Vec3& center, double half) {
  return ((x - center).cwiseAbs().array() <= half).all();
}

// Points evenly on the six sides of a cube.
std::vector<Vec3> cube_points(const Vec3& center, double half, int per_edge) {
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i < per_edge; ++i)
        for (int j = 0; j < per_edge; ++j) {
          Vec3 x;
          x[axis] = side;
          x[(axis + 1) % 3] = (2.0 * i + 1.0) / per_edge - 1.0;
          x[(axis + 2) % 3] = (2.0 * j + 1.0) / per_edge - 1.0;
          points.push_back(center + half * x);
        }
  return points;
}

// Child c of a cube lies in this direction.
Vec3 octant(int c) {
  return Vec3((c & 1) != 0 ? 1.0 : -1.0, (c & 2) != 0 ? 1.0 : -1.0, (c & 4) != 0 ? 1.0 : -1.0);
}

std::size_t octant_of(const Vec3& d) {
  return (d.x() > 0 ? 1U : 0U) + (d.y() > 0 ? 2U : 0U) + (d.z() > 0 ? 4U : 0U);
}

// Which points hang together.
struct Connection {
  std::vector<std::size_t> part;        // of each point
  std::vector<std::vector<Vec3>> hubs;  // of each part: from one of them each point can be seen
};

// From the most central point everything that can be seen, then from what was found, until nothing
// more turns up: the first part. The next starts from what is left.
Connection connect(const std::vector<Vec3>& points, const Vec3& center, const BodyQueries& body) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  Connection connection;
  connection.part.assign(points.size(), none);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double da = (points[a] - center).squaredNorm();
    const double db = (points[b] - center).squaredNorm();
    return da < db || (da == db && a < b);
  });
  for (const std::size_t seed : order) {
    if (connection.part[seed] != none) continue;
    const std::size_t mine = connection.hubs.size();
    connection.hubs.emplace_back();
    connection.part[seed] = mine;
    std::vector<std::size_t> found{seed};
    bool complete = false;
    for (std::size_t q = 0; q < found.size() && q < most_hubs && !complete; ++q) {
      const Vec3& hub = points[found[q]];
      connection.hubs.back().push_back(hub);
      complete = true;
      for (const std::size_t other : order) {
        if (connection.part[other] != none) continue;
        if (body.connected(hub, points[other])) {
          connection.part[other] = mine;
          found.push_back(other);
        } else {
          complete = false;
        }
      }
    }
  }
  return connection;
}

}  // namespace

PatchTree::PatchTree(std::shared_ptr<const SpreadKnots> knots, const PatchTreeOptions& options)
    : options_(options), surface_(std::move(knots)) {
  const Vec3 lo = surface_->positions.rowwise().minCoeff();
  const Vec3 hi = surface_->positions.rowwise().maxCoeff();
  Leaf root;
  root.center = 0.5 * (lo + hi);
  root.half = 0.5 * (hi - lo).maxCoeff() * (1.0 + root_margin);
  root.knots.resize(static_cast<std::size_t>(surface_->positions.cols()));
  for (std::size_t i = 0; i < root.knots.size(); ++i) root.knots[i] = static_cast<Eigen::Index>(i);
  nodes_.push_back(std::move(root));
  const double coarsest = 2.0 * nodes_[0].half / options.coarsest_per_size;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!can_split(i)) continue;
    const double edge = 2.0 * nodes_[i].half;
    if (edge > coarsest || edge > options.widest ||
        (edge > options.widest_at_surface &&
         touches(0, nodes_[i].center, surface_reach * nodes_[i].half)))
      split(i);
  }
}

void PatchTree::split(std::size_t index) {
  const auto first = nodes_.size();
  const Leaf parent = nodes_[index];
  for (int c = 0; c < 8; ++c) {
    Leaf child;
    child.half = 0.5 * parent.half;
    child.center = parent.center + child.half * octant(c);
    child.level = parent.level + 1;
    nodes_.push_back(std::move(child));
  }
  for (const Eigen::Index i : parent.knots) {
    const Vec3 d = surface_->positions.col(i) - parent.center;
    nodes_[first + octant_of(d)].knots.push_back(i);
  }
  nodes_[index].first_child = static_cast<int>(first);
  nodes_[index].knots = {};
}

void PatchTree::gather(std::size_t node, const Vec3& center, double half,
                       std::vector<Eigen::Index>& found) const {
  const Leaf& leaf = nodes_[node];
  if (!within(leaf.center, center, half + leaf.half)) return;
  if (leaf.first_child >= 0) {
    for (int c = 0; c < 8; ++c)
      gather(static_cast<std::size_t>(leaf.first_child) + static_cast<std::size_t>(c), center, half,
             found);
    return;
  }
  for (const Eigen::Index i : leaf.knots)
    if (within(surface_->positions.col(i), center, half)) found.push_back(i);
}

bool PatchTree::touches(std::size_t node, const Vec3& center, double half) const {
  const Leaf& leaf = nodes_[node];
  if (!within(leaf.center, center, half + leaf.half)) return false;
  if (leaf.first_child < 0)
    return std::any_of(leaf.knots.begin(), leaf.knots.end(), [&](Eigen::Index i) {
      return within(surface_->positions.col(i), center, half);
    });
  for (int c = 0; c < 8; ++c)
    if (touches(static_cast<std::size_t>(leaf.first_child) + static_cast<std::size_t>(c), center,
                half))
      return true;
  return false;
}

std::vector<Patch> PatchTree::parts(std::size_t index, const BodyQueries& body) const {
  const Leaf& leaf = nodes_[index];
  if (leaf.knots.empty() && !body.inside(leaf.center)) return {};
  const double wide = leaf.half * (1.0 + 2.0 * options_.overlap);
  Patch whole;
  whole.leaf = index;
  whole.joints = cube_points(leaf.center, wide, options_.joints_per_edge);
  whole.joint_area = 24.0 * wide * wide / static_cast<double>(whole.joints.size());
  gather(0, leaf.center, wide, whole.knots);
  if (whole.knots.empty()) {
    whole.hubs = {leaf.center};
    whole.center = leaf.center;
    whole.radius = std::sqrt(3.0) * wide;
    return {whole};
  }

  // Prefixes of the knots are evenly spread: the lowest indices stand for all.
  const SpreadKnots& knots = *surface_;
  std::sort(whole.knots.begin(), whole.knots.end());
  const std::size_t count = std::min(whole.knots.size(), options_.most_knots);
  whole.knot_area = knots.area / static_cast<double>(knots.positions.cols()) *
                    static_cast<double>(whole.knots.size()) / static_cast<double>(count);
  whole.knots.resize(count);
  const PatchSamples samples = sample(whole, leaf, body);
  const Connection connection = connect(samples.points, leaf.center, body);

  std::vector<Patch> result;
  for (std::size_t c = 0; c < connection.hubs.size(); ++c) {
    Patch patch;
    patch.leaf = index;
    patch.knot_area = whole.knot_area;
    patch.joint_area = whole.joint_area;
    patch.hubs = connection.hubs[c];
    bool in_leaf = false;
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      if (connection.part[i] != c) continue;
      in_leaf |= samples.in_leaf[i] != 0;
      if (i < samples.joints_begin) {
        patch.knots.push_back(whole.knots[i]);
        box.extend(Vec3(knots.positions.col(whole.knots[i])));
      } else if (i < samples.joints_end) {
        patch.joints.push_back(samples.points[i]);
        box.extend(samples.points[i]);
      }
    }
    if (!in_leaf || box.isEmpty()) continue;
    patch.center = box.center();
    for (const Eigen::Index i : patch.knots)
      patch.radius = std::max(patch.radius, (knots.positions.col(i) - patch.center).norm());
    for (const Vec3& x : patch.joints)
      patch.radius = std::max(patch.radius, (x - patch.center).norm());
    if (patch.radius > 0.0) result.push_back(std::move(patch));
  }
  return result;
}

// One for each knot of `whole`, then one for each joint inside, then more of the leaf itself, so
// that each of its parts has one.
PatchTree::PatchSamples PatchTree::sample(const Patch& whole, const Leaf& leaf,
                                          const BodyQueries& body) const {
  const SpreadKnots& knots = *surface_;
  PatchSamples samples;
  const auto add = [&](const Vec3& x, bool in_leaf) {
    samples.points.push_back(x);
    samples.in_leaf.push_back(in_leaf);
  };
  // Under a knot, half-way to the opposite wall where the body is thin.
  const auto under = [&](Eigen::Index i) -> Vec3 {
    const Vec3 x = knots.positions.col(i), n = knots.normals.col(i);
    return x - 0.5 * std::min(leaf.half, body.thickness(x, -n)) * n;
  };
  for (const Eigen::Index i : whole.knots)
    add(under(i), within(knots.positions.col(i), leaf.center, leaf.half));
  samples.joints_begin = samples.points.size();
  for (const Vec3& x : whole.joints)
    if (body.inside(x)) add(x, false);
  samples.joints_end = samples.points.size();
  // Knots of the leaf that are not among those chosen still stand for a part.
  for (std::size_t i = 0; i < leaf.knots.size() && i < most_hubs; ++i)
    add(under(leaf.knots[i]), true);
  for (int c = 0; c < 8; ++c) {
    const Vec3 x = leaf.center + 0.5 * leaf.half * octant(c);
    if (body.inside(x)) add(x, true);
  }
  return samples;
}

void PatchTree::make_patches(const BodyQueries& body, const Workers& workers) {
  patches_.clear();
  for (Leaf& leaf : nodes_) leaf.patches.clear();
  std::vector<std::size_t> leaves;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].first_child < 0) leaves.push_back(i);
  while (!leaves.empty()) {
    std::vector<std::vector<Patch>> found(leaves.size());
    constexpr std::size_t chunk = 16;
    workers.for_chunks(leaves.size(), chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) found[i] = parts(leaves[i], body);
    });
    std::vector<std::size_t> again;
    std::size_t in_all = patches_.size();
    for (const std::vector<Patch>& parts_found : found) in_all += parts_found.size();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      // Each of eight children may hold as many parts; where they are too many, a leaf keeps
      // several.
      if (found[i].size() > 1 && can_split(leaves[i]) &&
          in_all + 8 * (again.size() + 1) < options_.most_patches) {
        again.push_back(leaves[i]);
        continue;
      }
      for (Patch& patch : found[i]) {
        nodes_[leaves[i]].patches.push_back(patches_.size());
        patches_.push_back(std::move(patch));
      }
    }
    leaves.clear();
    for (const std::size_t leaf : again) {
      split(leaf);
      for (int c = 0; c < 8; ++c)
        leaves.push_back(static_cast<std::size_t>(nodes_[leaf].first_child) +
                         static_cast<std::size_t>(c));
    }
  }
}

std::size_t PatchTree::leaf_at(const Vec3& x) const {
  std::size_t at = 0;
  while (nodes_[at].first_child >= 0) {
    const Vec3 d = x - nodes_[at].center;
    at = static_cast<std::size_t>(nodes_[at].first_child) + octant_of(d);
  }
  return at;
}

std::ptrdiff_t PatchTree::owner(const Vec3& x, const BodyQueries& body) const {
  if (patches_.empty()) return -1;
  const std::vector<std::size_t>& own = nodes_[leaf_at(x)].patches;
  if (own.size() == 1) return static_cast<std::ptrdiff_t>(own[0]);
  for (const std::size_t p : own)
    for (const Vec3& hub : patches_[p].hubs)
      if (body.connected(hub, x)) return static_cast<std::ptrdiff_t>(p);
  // A leaf without knots whose centre is outside, just touched by the surface: the nearest patch.
  std::size_t best = own.empty() ? 0 : own[0];
  double nearest = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::size_t p) {
    const double d = (x - patches_[p].center).norm() / patches_[p].radius;
    if (d < nearest) nearest = d, best = p;
  };
  if (own.empty())
    for (std::size_t p = 0; p < patches_.size(); ++p) consider(p);
  else
    for (const std::size_t p : own) consider(p);
  return static_cast<std::ptrdiff_t>(best);
}

}  // namespace knotlight
