// How wide the radial functions of dual reciprocity should be.
#pragma once

#include <Eigen/Core>

#include "bkm/assembly.h"
#include "bkm/dense_solver.h"
#include "core/vec3.h"

namespace knotlight {

// Width c, in mean knot spacings, where the scene does not give one. A compromise, measured in
// docs/results/bkm-thesis.md; the thesis finds the width decisive and gives no rule [V09
// fig. 7.10].
double default_shape_parameter();

struct ShapeChoice {
  double c = 0.0;      // length
  double error = 0.0;  // rms of what a knot's value is off if the others predict it, in units of f
  int factorisations = 0;
};

// The width with the least leave-one-out error [R99] of f, K values at K points: widths from 1 to
// 16 spacings by factors of 2, then twice the middle between the best and its neighbours: 9
// factorisations, to within a factor 2^(1/4). radial.c is ignored; has_width(radial.kind). spacing:
// length. If no width gives a finite error, the default and NaN.
ShapeChoice leave_one_out_width(const Points& points, const Eigen::VectorXd& f,
                                RadialFunction radial, double spacing,
                                const AssemblyOptions& assembly, const DenseSolverOptions& solver);

}  // namespace knotlight
