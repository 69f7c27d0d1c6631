// What a surface does to light that diffuses towards it: Milne's problem, with the internal
// reflection of a smooth dielectric.
#pragma once

#include <vector>

#include "core/curvature.h"

namespace knotlight {

// Far below a plane surface without absorption the mean intensity is tau + q(inf), tau = optical
// depth; at the surface it is tau + q(tau). q(inf) is the exact extrapolation length: 0.7104
// without reflection (q is Hopf's function then [H34]), 1.85 at ior 1.4, where P1 has 1.97. From
// the integral equation, isotropic scattering; errors below 1e-3.
class SurfaceLayer {
 public:
  explicit SurfaceLayer(double ior);

  // q(inf), mean free paths.
  double extrapolation() const { return q_.back(); }
  // q at an optical depth; below 0 as at 0.
  double q(double tau) const;

  // How much less (or more) the mean intensity is at the optical depth tau, and how much less a
  // source there is worth to all that is far away (reciprocity), than by the diffusion equation
  // with the extrapolation length k (mean free paths): (tau + k - q(inf) + q(tau)) / (tau + k).
  // excess_curvature: of the surface here over what k stands for, 1/mean free path; half of its
  // effect, since between two places below the same surface it counts once and both have a weight.
  double weight(double tau, double k, double excess_curvature) const;

 private:
  std::vector<double> tau_, q_;  // increasing tau
};

// The extrapolation length k (mean free paths) of a surface bent with the mean curvature H (1/mean
// free path): k / (1 + 0.7104 H). The field falls towards 0 at a distance beyond the surface, not
// by a slope that is the same whatever the shape; first order in H, without reflection [D57].
double bent_extrapolation(double k, double curvature);

// All that light feels of an object's surface.
struct FeltSurface {
  SurfaceCurvature curvature;
  SurfaceLayer layer;
};

}  // namespace knotlight
