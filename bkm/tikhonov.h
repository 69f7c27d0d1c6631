// How much to damp: Tikhonov's x = sum_i (s_i^2 / (s_i^2 + mu^2)) (u_i . b / s_i) v_i minimises
// |A x - b|^2 + mu^2 |x|^2; mu is chosen from the data alone, by one singular value decomposition.
#pragma once

#include <Eigen/Core>

namespace knotlight {

// What both rules need of A x = b.
struct DataSpectrum {
  Eigen::VectorXd s;             // l singular values > 0, decreasing
  Eigen::VectorXd coefficients;  // l: u_i . b
  double outside_squared = 0.0;  // |b|^2 outside the span of the u_i
  Eigen::Index rows = 0;         // of A, >= l
};

// Both look at mu between the smallest and the largest of s; not-a-number in, not-a-number out.

// Minimum of |A x - b|^2 / (rows - sum_i f_i)^2, f_i = s_i^2 / (s_i^2 + mu^2): generalised
// cross-validation [GHW79]. Knows nothing of the noise but that it is white.
double gcv_regulariser(const DataSpectrum& data);

// Corner of the curve (log |A x - b|, log |x|), where its curvature is largest [H92].
double l_curve_regulariser(const DataSpectrum& data);

}  // namespace knotlight
