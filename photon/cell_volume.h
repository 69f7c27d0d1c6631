// The part of grid cells that a closed surface encloses.
#pragma once

#include <vector>

#include "core/shape.h"
#include "photon/flux_grid.h"

namespace knotlight {

// Volume of the part of each cell that lies inside the closed shape; length^3. For a mesh exact to
// rounding (parts that the mesh encloses twice count twice), for a sphere to 1e-11 of a cell. What
// is below 1e-12 of a cell counts as nothing.
std::vector<double> volumes_inside(const Shape& shape, const FluxGrid& grid);

}  // namespace knotlight
