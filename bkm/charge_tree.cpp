#include "bkm/charge_tree.h"

#include <cmath>

#include "bkm/charge_order.h"

namespace knotlight {
namespace {

constexpr std::size_t nodes_per_chunk = 256;  // about a millisecond of expansions

// Cells are divided level by level. Returns the first node of each level, and the end.
std::vector<std::size_t> divide(ChargeTree& tree, const std::vector<OrderedCharge>& ordered) {
  ChargeNode root;
  root.charge_count = static_cast<std::uint32_t>(ordered.size());
  tree.nodes.push_back(root);
  std::vector<std::size_t> level_begin{0};
  for (int level = 0; level_begin.back() < tree.nodes.size(); ++level) {
    const std::size_t begin = level_begin.back();
    const std::size_t end = tree.nodes.size();
    level_begin.push_back(end);
    if (level == octree_levels) break;
    for (std::size_t i = begin; i < end; ++i) {
      const ChargeNode node = tree.nodes[i];
      if (node.charge_count <= leaf_charges) continue;
      tree.nodes[i].first_child = static_cast<std::uint32_t>(tree.nodes.size());
      auto first = ordered.begin() + node.first_charge;
      const auto last = first + node.charge_count;
      while (first != last) {
        const int octant = first->octant(level);
        const auto next = std::partition_point(first, last, [&](const OrderedCharge& charge) {
          return charge.octant(level) == octant;
        });
        ChargeNode child;
        child.first_charge = static_cast<std::uint32_t>(first - ordered.begin());
        child.charge_count = static_cast<std::uint32_t>(next - first);
        tree.nodes.push_back(child);
        ++tree.nodes[i].child_count;
        first = next;
      }
    }
  }
  return level_begin;
}

void measure_leaf(ChargeNode& leaf, const std::vector<OrderedCharge>& ordered,
                  std::vector<DirectCharge>& charges) {
  const std::size_t end = leaf.first_charge + leaf.charge_count;
  for (std::size_t i = leaf.first_charge; i < end; ++i) {
    const double weight = std::abs(static_cast<double>(ordered[i].strength));
    leaf.center += weight * ordered[i].in_cube();
    leaf.strength += weight;
  }
  leaf.center /= leaf.strength;
  for (std::size_t i = leaf.first_charge; i < end; ++i) {
    const Vec3 offset = ordered[i].in_cube() - leaf.center;
    const float q = ordered[i].strength;
    leaf.radius = std::max(leaf.radius, offset.norm());
    leaf.mean_square += std::abs(static_cast<double>(q)) * offset.squaredNorm();
    charges[i] = {static_cast<float>(offset.x()), static_cast<float>(offset.y()),
                  static_cast<float>(offset.z()), q};
  }
  leaf.mean_square /= leaf.strength;
}

// From its children.
void measure_branch(ChargeNode& node, const ChargeNode* children) {
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    node.center += children[i].strength * children[i].center;
    node.strength += children[i].strength;
  }
  node.center /= node.strength;
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    const double shift = (children[i].center - node.center).norm();
    node.radius = std::max(node.radius, shift + children[i].radius);
    node.mean_square += children[i].strength * (children[i].mean_square + shift * shift);
  }
  node.mean_square /= node.strength;
}

void store_coefficients(const MonomialSums& moments, const ChargeNode& node, double lambda,
                        float* out) {
  const double scale = node.scale();
  MonomialSums scaled;  // moments with lengths in units of scale
  double power = 1.0;
  for (int n = 0; n <= cluster_degree; ++n, power /= scale)
    for (int i = monomials(n - 1); i < monomials(n); ++i) scaled[i] = moments[i] * power;
  const MonomialSums H = harmonic_coefficients(scaled, lambda * scale) / scale;
  for (int i = 0; i < cluster_terms; ++i) out[i] = static_cast<float>(H[i]);
}

}  // namespace

ChargeTree make_charge_tree(const ChargeSource& source, double lambda, const Workers& workers) {
  ChargeTree tree;
  const std::vector<OrderedCharge> ordered = order_charges(source, tree, workers);
  tree.lambda = lambda * tree.unit;
  if (ordered.empty()) return tree;
  const std::vector<std::size_t> level_begin = divide(tree, ordered);
  tree.charges.resize(ordered.size());
  tree.coefficients.resize(tree.nodes.size() * cluster_terms);

  // From the finest level up, so that moments are kept for two levels only.
  std::vector<MonomialSums> finer;
  for (std::size_t level = level_begin.size() - 1; level-- > 0;) {
    const std::size_t begin = level_begin[level];
    const std::size_t count = level_begin[level + 1] - begin;
    std::vector<MonomialSums> moments(count);
    workers.for_chunks(
        count, nodes_per_chunk, [&](std::size_t, std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) {
            ChargeNode& node = tree.nodes[begin + i];
            if (node.leaf()) {
              measure_leaf(node, ordered, tree.charges);
              moments[i] =
                  charge_moments(tree.charges.data() + node.first_charge, node.charge_count);
            } else {
              const ChargeNode* children = &tree.nodes[node.first_child];
              measure_branch(node, children);
              moments[i].setZero();
              for (std::uint32_t c = 0; c < node.child_count; ++c)
                moments[i] += shifted_moments(finer[node.first_child + c - level_begin[level + 1]],
                                              children[c].center - node.center);
            }
            node.grown = std::exp(tree.lambda * node.radius);
            store_coefficients(moments[i], node, tree.lambda,
                               &tree.coefficients[(begin + i) * cluster_terms]);
          }
        });
    finer = std::move(moments);
  }
  return tree;
}

}  // namespace knotlight
