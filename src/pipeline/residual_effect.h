// What a residual of the Robin condition does to the field.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/parallel.h"
#include "core/vec3.h"

namespace knotlight {

// The mean square on the surface of the error e that a residual leaves, lap e - lambda^2 e = 0
// inside, e + k de/dn = residual on the surface, from independent samples of the residual at N
// points that are spread evenly over the surface (positions 3 x N): what both samples have in
// common, with two standard errors of the estimate on top; at most the mean square of the residual
// itself, the bound of the maximum principle. 0 for N < 2.
//
// Next to a plane a residual of wave number w leaves e = residual / (1 + k sqrt(w^2 + lambda^2)):
// what changes over distances shorter than k, as that of facets and of noise, is smoothed away.
double mean_square_effect(const Points& positions, const std::array<Eigen::VectorXd, 2>& residuals,
                          double k, const Workers& workers);

}  // namespace knotlight
