// Charges in the order of an octree's cells: those of every cell are then a run, down to cells with
// no more than a leaf has.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bkm/charge_tree.h"

namespace knotlight {

// A charge in sixteen bytes: coordinates in 2^-32 of the cube's edge, fine enough to stand for
// double, and in this form their leading bits name the octree's cells.
struct OrderedCharge {
  std::array<std::uint32_t, 3> position;
  float strength;  // in units of the largest |q|

  Vec3 in_cube() const {
    constexpr double step = 1.0 / 4294967296.0;
    return step * Vec3(position[0], position[1], position[2]);
  }
  // Which of the eight parts of its cell of level `level` (0: the cube) the charge is in.
  int octant(int level) const {
    const int shift = 31 - level;
    return static_cast<int>((position[0] >> shift & 1U) << 2U | (position[1] >> shift & 1U) << 1U |
                            (position[2] >> shift & 1U));
  }
};
constexpr int octree_levels = 32;

// Cells with more charges are divided. A point with so many charges costs about as much as with
// eight expansions; with fewer, expansions and their making cost more than they save.
constexpr std::uint32_t leaf_charges = 128;

// Sets origin, unit and strength_unit of the tree and returns its charges in order.
std::vector<OrderedCharge> order_charges(const ChargeSource& source, ChargeTree& tree,
                                         const Workers& workers);

}  // namespace knotlight
