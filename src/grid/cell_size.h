// How small cells have to be.
#pragma once

#include <cstddef>

#include "core/shape.h"

namespace knotlight {

struct CellSize {
  double h = 0.0;           // length
  double h_sigma_tr = 0.0;  // in transport mean free paths; the error grows as its square
  bool limited = false;     // the budget, not the rule, has set h
};

// h = sqrt(tolerance / 0.01) min(0.5 / sigma_tr, size / 64): the field changes over a transport
// mean free path and over the size of the object, and the error is of second order. The
// measurements behind the numbers are in docs/grid.md. sigma_tr: the largest of the channels that
// share the grid, 1/length. At most `most_cells` cells inside the object and 8 times as many in its
// bounding box; 2 million take about 0.6 GiB.
CellSize cell_size_for(const Shape& shape, double sigma_tr, double tolerance,
                       std::size_t most_cells = 2'000'000);

}  // namespace knotlight
