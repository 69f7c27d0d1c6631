// What tests and other studies ask of the study of singular values.
#pragma once

#include "core/shape.h"

namespace knotlight {

// Numerical rank (cut 1e-14) of the boundary matrix of the unit ball with `count` knots.
// lambda: 1/length; k: length.
int ball_rank(int count, double lambda, double k);

// Evenly spread points of the unit sphere: the Fibonacci lattice.
SurfaceSamples fibonacci_knots(int count);

}  // namespace knotlight
