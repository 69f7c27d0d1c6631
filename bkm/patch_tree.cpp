#include "bkm/patch_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
    child.center =
        parent.center + child.half * Vec3((c & 1) ? 1 : -1, (c & 2) ? 1 : -1, (c & 4) ? 1 : -1);
    child.level = parent.level + 1;
    nodes_.push_back(std::move(child));
  }
  for (const Eigen::Index i : parent.knots) {
    const Vec3 d = surface_->positions.col(i) - parent.center;
    nodes_[first + (d.x() > 0 ? 1 : 0) + (d.y() > 0 ? 2 : 0) + (d.z() > 0 ? 4 : 0)].knots.push_back(
        i);
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
      gather(static_cast<std::size_t>(leaf.first_child + c), center, half, found);
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
    if (touches(static_cast<std::size_t>(leaf.first_child + c), center, half)) return true;
  return false;
}

std::vector<Patch> PatchTree::parts(std::size_t index, const BodyQueries& body) const {
  const SpreadKnots& knots = *surface_;
  const Leaf& leaf = nodes_[index];
  const double wide = leaf.half * (1.0 + 2.0 * options_.overlap);
  std::vector<Eigen::Index> near;
  gather(0, leaf.center, wide, near);
  const bool empty = leaf.knots.empty() && !body.inside(leaf.center);
  if (empty) return {};
  const std::size_t count = near.size();
  // Prefixes of the knots are evenly spread: the lowest indices stand for all.
  std::sort(near.begin(), near.end());
  double knot_area = knots.area / static_cast<double>(knots.positions.cols());
  if (near.size() > options_.most_knots) {
    knot_area *= static_cast<double>(count) / static_cast<double>(options_.most_knots);
    near.resize(options_.most_knots);
  }

  std::vector<Vec3> joints = cube_points(leaf.center, wide, options_.joints_per_edge);
  const double joint_area = 24.0 * wide * wide / static_cast<double>(joints.size());
  if (near.empty()) {
    Patch patch;
    patch.joints = std::move(joints);
    patch.joint_area = joint_area;
    patch.hubs = {leaf.center};
    patch.leaf = index;
    patch.center = leaf.center;
    patch.radius = std::sqrt(3.0) * wide;
    return {patch};
  }

  // A point inside for each knot: half-way to the opposite wall where the body is thin.
  std::vector<Vec3> samples;
  std::vector<char> core;
  for (const Eigen::Index i : near) {
    const Vec3 x = knots.positions.col(i), n = knots.normals.col(i);
    const double depth = std::min(0.5 * leaf.half, 0.5 * body.thickness(x, -n));
    samples.push_back(x - depth * n);
    core.push_back(within(x, leaf.center, leaf.half));
  }
  const std::size_t from_knots = samples.size();
  // Knots of the leaf itself that are not among the chosen ones still stand for a part.
  for (std::size_t i = 0; i < leaf.knots.size() && i < most_hubs; ++i) {
    const Vec3 x = knots.positions.col(leaf.knots[i]), n = knots.normals.col(leaf.knots[i]);
    samples.push_back(x - std::min(0.5 * leaf.half, 0.5 * body.thickness(x, -n)) * n);
    core.push_back(1);
  }
  const std::size_t first_joint = samples.size();
  for (const Vec3& x : joints)
    if (body.inside(x)) {
      samples.push_back(x);
      core.push_back(0);
    }
  const std::size_t last_joint = samples.size();
  for (int c = 0; c < 8; ++c) {
    const Vec3 x =
        leaf.center + 0.5 * leaf.half * Vec3((c & 1) ? 1 : -1, (c & 2) ? 1 : -1, (c & 4) ? 1 : -1);
    if (body.inside(x)) {
      samples.push_back(x);
      core.push_back(1);
    }
  }

  std::vector<int> part(samples.size(), -1);
  std::vector<std::vector<Vec3>> hubs;
  int parts_found = 0;
  std::vector<std::size_t> order(samples.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double da = (samples[a] - leaf.center).squaredNorm();
    const double db = (samples[b] - leaf.center).squaredNorm();
    return da < db || (da == db && a < b);
  });
  for (const std::size_t seed : order) {
    if (part[seed] >= 0) continue;
    const int mine = parts_found++;
    hubs.emplace_back();
    part[seed] = mine;
    std::vector<std::size_t> queue{seed};
    std::size_t unassigned = 1;
    for (std::size_t q = 0; q < queue.size() && q < most_hubs && unassigned > 0; ++q) {
      const Vec3 hub = samples[queue[q]];
      hubs.back().push_back(hub);
      unassigned = 0;
      for (const std::size_t other : order) {
        if (part[other] >= 0) continue;
        if (body.connected(hub, samples[other])) {
          part[other] = mine;
          queue.push_back(other);
        } else {
          ++unassigned;
        }
      }
    }
  }

  std::vector<Patch> result;
  for (int c = 0; c < parts_found; ++c) {
    bool belongs = false;
    for (std::size_t i = 0; i < samples.size(); ++i) belongs |= part[i] == c && core[i] != 0;
    if (!belongs) continue;
    Patch patch;
    patch.leaf = index;
    patch.knot_area = knot_area;
    patch.joint_area = joint_area;
    patch.hubs = hubs[static_cast<std::size_t>(c)];
    for (std::size_t i = 0; i < from_knots; ++i)
      if (part[i] == c) patch.knots.push_back(near[i]);
    for (std::size_t i = first_joint; i < last_joint; ++i)
      if (part[i] == c) patch.joints.push_back(samples[i]);
    Eigen::AlignedBox3d box;
    for (const Eigen::Index i : patch.knots) box.extend(Vec3(knots.positions.col(i)));
    for (const Vec3& x : patch.joints) box.extend(x);
    if (box.isEmpty()) continue;
    patch.center = box.center();
    for (const Eigen::Index i : patch.knots)
      patch.radius = std::max(patch.radius, (knots.positions.col(i) - patch.center).norm());
    for (const Vec3& x : patch.joints)
      patch.radius = std::max(patch.radius, (x - patch.center).norm());
    if (patch.radius > 0.0) result.push_back(std::move(patch));
  }
  return result;
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
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (found[i].size() > 1 && can_split(leaves[i])) {
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
        leaves.push_back(static_cast<std::size_t>(nodes_[leaf].first_child + c));
    }
  }
}

std::size_t PatchTree::leaf_at(const Vec3& x) const {
  std::size_t at = 0;
  while (nodes_[at].first_child >= 0) {
    const Vec3 d = x - nodes_[at].center;
    at = static_cast<std::size_t>(nodes_[at].first_child + (d.x() > 0 ? 1 : 0) +
                                  (d.y() > 0 ? 2 : 0) + (d.z() > 0 ? 4 : 0));
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
