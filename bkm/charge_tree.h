// An octree over point charges, with the expansion of each cell's charges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "bkm/charge_cluster.h"
#include "bkm/charge_lanes.h"
#include "bkm/robin_image.h"
#include "core/parallel.h"

namespace knotlight {

struct ChargeNode {
  Vec3 center = Vec3::Zero();  // mean position, weighted by absolute strength
  double radius = 0.0;         // all charges are within it of the centre
  double strength = 0.0;       // sum |q|
  double mean_square = 0.0;    // of the distance from the centre, weighted by |q|
  double grown = 1.0;          // exp(lambda radius)
  std::uint32_t first_charge = 0, charge_count = 0;
  std::uint32_t first_child = 0, child_count = 0;  // children follow each other; none: leaf

  bool leaf() const { return child_count == 0; }
  // Unit of length of the expansion; a cluster without extent gets some.
  double scale() const { return std::max(radius, 1e-7); }
};

// Charges are handed over by a function, in groups (a charge with its images), so that they never
// have to be stored before they are in order.
struct ChargeSource {
  static constexpr int largest_group = 1 + RobinImage::most_charges;
  std::size_t groups = 0;
  // Writes the group's charges, returns their number. Called several times for each group; must
  // give the same each time.
  std::function<int(std::size_t group, PointCharge* out)> charges;
};

// Lengths are in `unit`, the edge of the cube around all charges, positions relative to `origin`,
// strengths in `strength_unit`, the largest |q|: numbers of any scene then suit float.
struct ChargeTree {
  Vec3 origin = Vec3::Zero();
  double unit = 1.0;
  double strength_unit = 1.0;
  double lambda = 0.0;                // in 1/unit
  std::vector<ChargeNode> nodes;      // level by level from the root; empty without charges
  std::vector<DirectCharge> charges;  // a node's together; relative to the centre of their leaf
  // cluster_terms per node: harmonic polynomials of d/scale, divided by scale.
  std::vector<float> coefficients;

  const float* coefficients_of(std::uint32_t node) const {
    return coefficients.data() + std::size_t{node} * cluster_terms;
  }
};

// lambda: 1/length (not in units of the tree). Charges of strength 0 are left out. Same bits for
// any number of workers. Throws std::invalid_argument for charges that are not finite.
ChargeTree make_charge_tree(const ChargeSource& source, double lambda, const Workers& workers);

}  // namespace knotlight
