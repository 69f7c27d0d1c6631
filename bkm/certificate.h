// How wrong a solved field can be, from what it leaves of the equation and of the boundary
// condition at points that are not knots.
#pragma once

#include <Eigen/Core>

#include "bkm/thesis_solver.h"
#include "core/vec3.h"

namespace knotlight {

// The largest |w| that sources of size 1 and no boundary data can make in a body inside a ball of
// the given radius R: |lap w - lambda^2 w| <= 1 inside, w + k dw/dn = 0 on the boundary. length^2;
// the smaller of 1/lambda^2 and R^2/6 + k R/3.
//
// Let e = u~ - u with |lap e - lambda^2 e| <= d inside and |e + k de/dn| <= r on the boundary. Any
// w >= 0 with lap w - lambda^2 w <= -1 inside and w + k dw/dn >= 0 on the boundary gives
// |e| <= r + d w: both v = r + d w +- e satisfy lap v - lambda^2 v <= 0 inside and v + k dv/dn >= 0
// on the boundary, so v has no negative minimum, neither inside (maximum principle) nor on the
// boundary (there dv/dn <= 0, so v >= -k dv/dn >= 0).
// 1. w = 1/lambda^2.
// 2. With the ball about 0, w = R^2/6 + k R/3 - |x|^2/6: lap w = -1, w >= 0 (so -lambda^2 w <= 0),
//    and w + k dw/dn = (R^2 - |x|^2)/6 + k (R - x.n)/3 >= 0. Its largest value is R^2/6 + k R/3. In
//    the ball itself with lambda = 0, w is the solution and the bound is sharp.
double source_gain(double lambda, double k, double enclosing_radius);

struct Certificate {
  // rho = g - (u~ + k du~/dn) at the boundary check points, in units of u.
  double robin_residual_rms = 0.0;
  double robin_residual_max = 0.0;
  // f - f~ at the interior check points, in units of f.
  double source_residual_rms = 0.0;
  double source_residual_max = 0.0;
  double gain = 0.0;         // source_gain of the body, length^2
  double error_bound = 0.0;  // max|rho| + gain * max|f - f~|: bounds max|u - u~|, in units of u
  double scale = 0.0;        // max|u~| over all check points
  // error_bound over the least that max|u| can then be, scale - error_bound: 0 if there is no
  // error, infinite if nothing is left, NaN if anything that went in is not finite.
  double error_estimate = 0.0;
  bool trusted = false;  // every number that went in and the bound are finite
};

// The bound is that of the maximum principle, except that the maxima are taken over the check
// points only: exact in the limit of many. A NaN makes the maxima it enters, the bound and the
// estimate NaN; it is never left out.
// problem: what the field was solved for; boundary_points, boundary_normals (outward unit): 3 x P,
// P >= 1, not the knots; g: P Robin data; interior_points: 3 x Q; f: Q values of the source there.
Certificate certify(const BkmField& field, const BkmThesisProblem& problem,
                    const Points& boundary_points, const Points& boundary_normals,
                    const Eigen::VectorXd& g, const Points& interior_points,
                    const Eigen::VectorXd& f);

}  // namespace knotlight
