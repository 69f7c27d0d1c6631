// A triangle mesh cut along the planes of the grid: the surface in each cell, exactly.
#pragma once

#include <array>
#include <functional>

#include "core/mesh.h"
#include "grid/cell_grid.h"

namespace knotlight {

// A triangle that lies in one cell.
struct SurfacePiece {
  std::array<int, 3> cell;     // the cell on the inner side, for one that lies in a grid plane
  std::array<Vec3, 3> corner;  // in cell units
  Vec3 normal;                 // outward unit
  double area;                 // in faces of a cell
};

// Calls visit for each piece, triangle by triangle. `mesh` in cell units. The areas add up to the
// mesh's to rounding.
void for_each_surface_piece(const TriangleMesh& mesh,
                            const std::function<void(const SurfacePiece&)>& visit);
// Of one triangle alone.
void for_each_surface_piece(const TriangleMesh& mesh, std::size_t triangle,
                            const std::function<void(const SurfacePiece&)>& visit);

struct SurfaceNode {
  Vec3 position;
  double weight;  // in faces of a cell
};
// Six points exact for polynomials of degree 4 [D85].
std::array<SurfaceNode, 6> quadrature(const SurfacePiece& piece);

}  // namespace knotlight
