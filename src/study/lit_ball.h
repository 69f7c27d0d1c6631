// A ball whose light enters as boundary data alone: U + k dU/dn = max(0, cos theta), no source
// inside, in closed form.
#pragma once

#include <Eigen/Core>

namespace knotlight {

// The data of a distant lamp in the direction of cos theta = 1, without its factor. One of its
// derivatives jumps where the shadow begins.
inline double lit_ball_data(double cosine) {
  return cosine > 0.0 ? cosine : 0.0;
}

// U on the surface of the ball of radius 1, one per cosine. lambda > 0, k > 0 in units of the
// radius. From the Legendre series of max(0, mu), right to 1e-6 k^-1 of the largest value.
Eigen::VectorXd lit_ball_field(const Eigen::VectorXd& cosines, double lambda, double k);

}  // namespace knotlight
