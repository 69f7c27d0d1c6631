// Where the knots of dual reciprocity lie, and how wide its Gaussians are by default. (Boundary
// knots are stratified_surface_points of core/shape.h.)
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/vec3.h"

namespace knotlight {

struct InteriorKnots {
  Points points;            // 3 x M, in the order of depths, then of boundary points
  std::size_t dropped = 0;  // candidates for which `inside` was false; M + dropped = all
};

// Candidates below each boundary point along the inward normal, one per depth (length), as [V09
// ch. 7] has them at 1 and 3/2 mean free paths; those that `inside` rejects (thin parts, sharp
// edges) are dropped. boundary_points, boundary_normals (outward unit): 3 x N.
InteriorKnots interior_knots(const Points& boundary_points, const Points& boundary_normals,
                             const std::vector<double>& depths,
                             const std::function<bool(const Vec3&)>& inside);

// sqrt(area / knots), length: the side of the patch of surface that belongs to one knot.
double mean_knot_spacing(double area, std::size_t knots);

// Width c of the Gaussians, in mean knot spacings, where the scene does not give one. The choice
// is a compromise, measured in docs/results/bkm-thesis.md; the thesis finds the width decisive and
// gives no rule [V09 fig. 7.10].
double default_shape_parameter();

}  // namespace knotlight
