// How wrong a solved field can be, from what it leaves of the equation and of the boundary
// condition at points that are not knots.
#pragma once

#include <Eigen/Core>

#include "bkm/thesis_solver.h"
#include "core/vec3.h"

namespace knotlight {

// The largest |w| that sources of size 1 and no boundary data can make in a body inside a ball of
// the given radius: |lap w - lambda^2 w| <= 1 inside, w + k dw/dn = 0 on the boundary. length^2.
// Derivation in certificate.cpp; sharp for the ball itself with lambda = 0.
double source_gain(double lambda, double k, double enclosing_radius);

struct Certificate {
  // rho = g - (u~ + k du~/dn) at the boundary check points, in units of u.
  double robin_residual_rms = 0.0;
  double robin_residual_max = 0.0;
  // f - f~ at the interior check points, in units of f.
  double source_residual_rms = 0.0;
  double source_residual_max = 0.0;
  double gain = 0.0;            // source_gain of the body, length^2
  double error_bound = 0.0;     // max|rho| + gain * max|f - f~|: bounds max|u - u~|, in units of u
  double scale = 0.0;           // max|u~| over all check points
  double error_estimate = 0.0;  // error_bound / scale; 0 if both are 0, infinite if only scale is
  bool trusted = false;         // every number that went in and every one above is finite
};

// The bound is that of the maximum principle, except that the maxima are taken over the check
// points only: exact in the limit of many. Anything not finite makes the maxima it enters, the
// bound and the estimate NaN, and the result untrusted.
// problem: what the field was solved for; boundary_points, boundary_normals (outward unit): 3 x P,
// P >= 1, not the knots; g: P Robin data; interior_points: 3 x Q; f: Q values of the source there.
Certificate certify(const BkmField& field, const BkmThesisProblem& problem,
                    const Points& boundary_points, const Points& boundary_normals,
                    const Eigen::VectorXd& g, const Points& interior_points,
                    const Eigen::VectorXd& f);

}  // namespace knotlight
