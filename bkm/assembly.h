// The two matrices of the method, row = collocation point, column = kernel.
#pragma once

#include <Eigen/Core>

#include "core/vec3.h"

namespace knotlight {

// phi(|x_i - x_j|) of all pairs of the K points, K x K, symmetric; 1/length^2. [V09 5.20, 6.16]
Eigen::MatrixXd source_matrix(const Points& points, double c, double lambda);

// Robin operator 1 + k d/dn (n outward; the thesis's normal points inward, hence its minus) of the
// non-singular solution of every knot, at every knot, N x N, no unit. [V09 5.25, 6.13]
// normals: 3 x N, unit; k, R: length.
Eigen::MatrixXd robin_matrix(const Points& knots, const Points& normals, double lambda, double k,
                             double R);

// Sets to zero what is below 1e-30 of the largest entry. [V09 ch. 6.3] has 1e-30 itself; relative,
// the rule does not depend on the unit of length. Not-a-number stays.
void zero_tiny_entries(Eigen::MatrixXd& a);

}  // namespace knotlight
