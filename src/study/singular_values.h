// What tests ask of the study of singular values.
#pragma once

namespace knotlight {

// Numerical rank (cut 1e-14) of the boundary matrix of the unit ball with `count` knots.
// lambda: 1/length; k: length.
int ball_rank(int count, double lambda, double k);

}  // namespace knotlight
