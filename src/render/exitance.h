// From the solved mean intensity at the surface to the radiance that leaves it: the last step from
// a field to a picture.
#pragma once

#include "core/medium.h"
#include "scene/scene.h"

namespace knotlight {

// Radiance leaving in a direction is scale * U_d * T * (1 + slope * mu_inside), T = Fresnel
// transmittance. Scaled so that the flux through the surface is F_n = 2 pi U_d / A whatever the
// angular form, but for mean_intensity, which is the thesis's L = U_d [V09 6.29] unchanged.
class LeavingRadiance {
 public:
  // model: p1 (slope 3 / (2 A), from L = U_d + (3 / 4 pi) F_d . w [I78]), lambert (slope 0) or
  // mean_intensity. A: that the field was solved with (DiffusionCoefficients).
  LeavingRadiance(double ior, double A, Exitance model);

  // cos_out = cosine in (0, 1] between the outward normal and the direction of the leaving light,
  // outside the object. U_d in W/(length^2 sr); so is the result.
  double operator()(double U_d, double cos_out) const;

 private:
  double ior_;
  double scale_;
  double slope_;
  bool mean_intensity_;
};

}  // namespace knotlight
