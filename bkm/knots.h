// Where the knots lie: on the surface, and those of dual reciprocity inside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/bkm_choices.h"
#include "core/shape.h"
#include "core/vec3.h"

namespace knotlight {

// `count` knots on the surface by the given layout; the same for the same seed.
//   vertices    those of a mesh, thinned out to `count` if there are more, all if there are fewer;
//               their normals are the mean of the facets' around, weighted by angle. Of a sphere
//               the vertices of an icosahedron, its edges divided: 10 n^2 + 2 of them, as near to
//               `count` as can be
//   stratified, jittered   centres or random points of strata of equal area (core/shape.h)
//   blue_noise  of 16 random points for each knot those that lie furthest from each other
SurfaceSamples surface_knots(const Shape& shape, KnotLayout layout, std::size_t count,
                             std::uint64_t seed);

// Indices of `count` of the points, each the one furthest from those before it; the first is point
// 0, and of equals the first. Their smallest distance is at least half of the largest that any
// choice of as many could have [G85]. count <= points.
std::vector<Eigen::Index> farthest_points(const Points& points, std::size_t count);

struct InteriorKnots {
  Points points;            // 3 x M
  std::size_t dropped = 0;  // candidates for which `inside` was false; M + dropped = all
};

// Depths of a layout's layers, in transport mean free paths; none with none and grid.
std::vector<double> layer_depths(InteriorLayout layout);

// Candidates below each boundary point along the inward normal, one per depth (length), as [V09
// ch. 7] has them at 1 and 3/2 mean free paths; those that `inside` rejects (thin parts, sharp
// edges) are dropped. In the order of depths, then of boundary points. boundary_points,
// boundary_normals (outward unit): 3 x N.
InteriorKnots interior_knots(const Points& boundary_points, const Points& boundary_normals,
                             const std::vector<double>& depths,
                             const std::function<bool(const Vec3&)>& inside);

// The points of a cubic lattice that lie inside, at least half a lattice spacing from every
// boundary point; all others that lie in the box around the boundary count as dropped. The spacing
// is such that a body of the given volume holds about `count` of its points.
InteriorKnots grid_knots(const Points& boundary_points, double volume, std::size_t count,
                         const std::function<bool(const Vec3&)>& inside);

// sqrt(area / knots), length: the side of the patch of surface that belongs to one knot.
double mean_knot_spacing(double area, std::size_t knots);

}  // namespace knotlight
