// The error of a solution from a second one on cells of twice the size.
#pragma once

#include "grid/solver.h"

namespace knotlight {

struct GridErrorEstimate {
  double rms = 0.0;      // over the points, relative to the largest |u|
  double largest = 0.0;  // relative to the same
  double scale = 0.0;    // the largest |u| at the points
};

// fine: cells of size h; coarse: 2 h, the same sources. Points on the surface (3 x N) with outward
// normals. For order p the error of the fine solution is |u_h - u_2h| / (2^p - 1); p = 1.3 is
// taken, below the 2 of smooth fields, since cells that are cut differently on the two grids leave
// an irregular part, and less where cells are large beside the length 1/lambda over which light
// decays (cell_in_decay_lengths = lambda h). NaN values give NaN.
GridErrorEstimate estimate_error(const GridField& fine, const GridField& coarse,
                                 const Points& points, const Points& normals,
                                 double cell_in_decay_lengths);

}  // namespace knotlight
