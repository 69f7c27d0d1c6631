// Any shape as a triangle mesh in the grid's coordinates.
#pragma once

#include "core/shape.h"
#include "grid/cell_grid.h"

namespace knotlight {

// The smallest grid of cubes of edge h around the shape with a free layer of cells on each side.
CellGrid grid_around(const Shape& shape, double h);

// The surface in cell units. A sphere becomes a polyhedron of its exact volume with edges of a
// cell, whose distance from the sphere, h^2 / 8R at most, is far below the error of the method.
TriangleMesh mesh_in_cells(const Shape& shape, const CellGrid& grid);

}  // namespace knotlight
