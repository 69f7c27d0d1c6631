// A density that changes across the ball of its estimate: the exponential that fits the photons.
#pragma once

#include <vector>

#include "core/vec3.h"

namespace knotlight {

// Photons near x, seen from there.
struct LocalPhotons {
  std::vector<Vec3> offsets;    // u = position - x, in radii of the ball
  std::vector<double> weights;  // power times kernel, >= 0
};

// With weights v and the kernel's centroid m (0 for a whole ball, pulled inside at a boundary),
// rho(x + u) = rho(x) exp(b . u) has
//   sum v exp(-b.u) (u - m) = 0  and  rho(x) = sum v exp(-b.u) / mass
// in the mean: local likelihood density estimation with a log-linear density [L96]. b minimises the
// convex function log(sum v exp(-b.(u - m))). A plain average over half a ball at a
// boundary is wrong by the slope times 3/8 of the radius; this one by second derivatives only.
//
// Turns the weights into v exp(-b.u) and returns the relative standard error of their sum, from
// how each photon (as one of a Poisson process) moves both the sum and b. Where no exponential fits
// (too few photons, or all on one side of m), b = 0.
double carry_along_slope(LocalPhotons& photons, const Vec3& centroid);

// Relative standard error of a sum of independent photons' weights; infinite if there are none.
double relative_error_of_sum(const std::vector<double>& weights);

}  // namespace knotlight
