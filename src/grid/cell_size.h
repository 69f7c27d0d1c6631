// How small cells have to be.
#pragma once

#include <cstddef>

#include "core/shape.h"

namespace knotlight {

// Transport mean free paths. Beyond, the layer in which light is first scattered lies within one
// cell, also of a grid of twice the cell size, and comparing the two says nothing any more.
inline constexpr double coarsest_cells = 2.0;

struct CellSize {
  double h = 0.0;           // length
  double h_sigma_tr = 0.0;  // in transport mean free paths; the error grows as its square
  double wanted = 0.0;      // by the rule, without the budget; length
  // Whether the budget, not the rule, has set h.
  bool limited() const { return h > wanted; }
};

// h = sqrt(tolerance / 0.01) min(0.5 / sigma_tr, 0.75 / sigma_t, size / 64): the field changes over
// a transport mean free path, over the layer in which light is first scattered (thinner than that
// for g > 0) and over the size of the object, and the error is of second order. The measurements
// behind the numbers are in docs/grid.md. sigma_tr, sigma_t: the largest of the channels that share
// the grid, 1/length. At most `most_cells` cells inside the object and 8 times as many in its
// bounding box. Only that budget makes cells larger than `coarsest_cells`.
CellSize cell_size_for(const Shape& shape, double sigma_tr, double sigma_t, double tolerance,
                       std::size_t most_cells);

// What a tolerance may cost: 2 million cells, about 0.6 GiB, at 0.01 and above, more in proportion
// below, 8 million at most.
std::size_t cell_budget(double tolerance);

}  // namespace knotlight
