// `method: grid`: photons counted into the cells of a grid, finite elements cut off at the surface.
#pragma once

#include <memory>

#include "grid/cell_size.h"
#include "grid/geometry.h"
#include "pipeline/channel_problem.h"

namespace knotlight {

// An object on cells of size h and, for the error estimate, 2 h.
struct ObjectGrids {
  std::shared_ptr<const GridGeometry> fine;
  // Null if the fine grid's own second level will do.
  std::shared_ptr<const GridGeometry> coarse;
};

// Cells small enough for every channel of the object, if the budget allows.
CellSize grid_cell_size(const Object& object, int channels, const SolverSettings& settings);
// Cells of that size, or smaller ones if it is the tolerance's coarseness that keeps them from
// resolving the shape.
std::shared_ptr<const GridGeometry> resolving_geometry(const Object& object, int channels,
                                                       const SolverSettings& settings,
                                                       const Workers& workers);
ObjectGrids make_grids(const Object& object, int channels, const SolverSettings& settings,
                       const Workers& workers);

// problem.grids must not be null.
ChannelSolution solve_by_grid(const ChannelProblem& problem);

}  // namespace knotlight
