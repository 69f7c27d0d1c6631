// The matrices of the method, row = collocation point, column = kernel.
#pragma once

#include <Eigen/Core>

#include "bkm/radial_functions.h"
#include "core/parallel.h"
#include "core/vec3.h"

namespace knotlight {

// How entries are computed; neither changes what they are, but for rounding.
struct AssemblyOptions {
  DistancePrecision precision = DistancePrecision::double_precision;
  Workers workers = Workers(1);  // the same bits for any number
};

// phi(|x_i - x_j|) of rows x_i, R of them, and columns x_j, C of them: R x C; psi per length^2.
// [V09 5.20, 6.16]
Eigen::MatrixXd source_matrix(const Points& rows, const Points& columns, const RadialFunction& w,
                              const AssemblyOptions& options = {});

// The same of all pairs of one set of points: symmetric to the last bit.
Eigen::MatrixXd source_matrix(const Points& points, const RadialFunction& w,
                              const AssemblyOptions& options = {});

// Robin operator 1 + k d/dn (n outward; the thesis's normal points inward, hence its minus) of the
// function psi about every column, at every row, R x C. [V09 5.25, 6.13, 6.17]
// normals: 3 x R, unit; k: length.
Eigen::MatrixXd robin_matrix(const Points& rows, const Points& normals, const Points& columns,
                             double k, const RadialFunction& w,
                             const AssemblyOptions& options = {});

// Sets to zero what is below 1e-30 of the largest entry. [V09 ch. 6.3] has 1e-30 itself; relative,
// the rule does not depend on the unit of length. Not-a-number stays.
void zero_tiny_entries(Eigen::MatrixXd& a);

}  // namespace knotlight
