#include "core/phase_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knotlight {

using std::numbers::pi;

double henyey_greenstein(double mu, double g) {
  const double d = 1.0 + g * g - 2.0 * g * mu;
  return (1.0 - g * g) / (4.0 * pi * d * std::sqrt(d));
}

// Inverse of the cumulative distribution in mu [HG41; PBRT 11.3.1]. Below |g| = 1e-3 it loses
// digits to cancellation, so its series about g = 0 is used there (error below g^2).
Vec3 sample_henyey_greenstein(const Vec3& w, double g, double u, double v) {
  double mu;
  const double s = 2.0 * u - 1.0;
  if (std::abs(g) < 1e-3) {
    mu = s + 1.5 * g * (1.0 - s * s);
  } else {
    const double q = (1.0 - g * g) / (1.0 + g * s);
    mu = (1.0 + g * g - q * q) / (2.0 * g);
  }
  mu = std::clamp(mu, -1.0, 1.0);
  const double sin_theta = std::sqrt(1.0 - mu * mu);
  const double phi = 2.0 * pi * v;
  return Frame(w).to_world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), mu}).normalized();
}

}  // namespace knotlight
