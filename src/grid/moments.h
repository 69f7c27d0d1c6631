// Integrals over the part of a cell that lies inside the object, or over the surface in it, of all
// products of two trilinear shape functions. Along one axis such a product is one of
//   (1-x)^2,  x (1-x),  x^2,
// so 27 numbers per cell hold its mass, stiffness and boundary matrices for any lambda and k.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/vec3.h"

namespace knotlight {

// Moment a + 3 b + 9 c belongs to the product of x-function a, y-function b and z-function c.
// Cells are unit cubes here.
using Moments = std::array<double, 27>;
using ElementMatrix = Eigen::Matrix<double, 8, 8>;
using ElementVector = Eigen::Matrix<double, 8, 1>;

// Adds a quadrature point at local coordinates x (0..1 in the cell; outside it the same polynomials
// go on).
void add_point(Moments& moments, const Vec3& x, double weight);
// Of the whole cell.
Moments full_cell_moments();
// The integral of 1.
double total(const Moments& moments);
// Adds to the moments of a cell of twice the edge those of its child at `corner`; `measure` is the
// child's unit over the parent's: 1/8 for volumes, 1/4 for surfaces.
void add_to_parent(Moments& parent, const Moments& child, int corner, double measure);

// int N_i N_j, row and column = corner.
ElementMatrix mass_matrix(const Moments& moments);
// int grad N_i . grad N_j.
ElementMatrix stiffness_matrix(const Moments& moments);
// N_i at local coordinates x.
ElementVector shape_functions(const Vec3& x);

}  // namespace knotlight
