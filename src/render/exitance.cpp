#include "render/exitance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/fresnel.h"

namespace knotlight {

// With L_out = C T(mu) (1 + c mu), mu the cosine inside, and mu_out dw_out = ior^2 mu dw [radiance
// compression], the flux is C ior^2 pi m(c), m(c) = transmitted_flux_moment. It must be 2 pi U_d/A.
LeavingRadiance::LeavingRadiance(double ior, double A, Exitance model)
    : ior_(ior), mean_intensity_(model == Exitance::mean_intensity) {
  assert(model != Exitance::gather);
  slope_ = model == Exitance::p1 ? 3.0 / (2.0 * A) : 0.0;
  scale_ = mean_intensity_ ? 1.0 : 2.0 / (A * ior_ * ior_ * transmitted_flux_moment(ior_, slope_));
}

double LeavingRadiance::operator()(double U_d, double cos_out) const {
  if (mean_intensity_) return U_d;
  const double sin2_inside = (1.0 - cos_out * cos_out) / (ior_ * ior_);
  const double cos_inside = std::sqrt(std::max(0.0, 1.0 - sin2_inside));
  const double transmittance = 1.0 - fresnel_reflectance(cos_out, ior_);
  return scale_ * U_d * transmittance * (1.0 + slope_ * cos_inside);
}

}  // namespace knotlight
