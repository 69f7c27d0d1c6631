#include "core/fresnel.h"

#include <cmath>
#include <functional>

namespace knotlight {
namespace {

// Integral over mu in (0, 1) of a function of the internal Fresnel reflectance, which is 1 up to
// the critical cosine and has a square-root kink there: mu = mu_c + (1 - mu_c) t^2 makes the
// integrand smooth, and composite Simpson then converges at fourth order.
double integrate_above_critical(double ior, const std::function<double(double mu, double R)>& f) {
  const double mu_c = ior > 1.0 ? std::sqrt(1.0 - 1.0 / (ior * ior)) : 0.0;
  constexpr int intervals = 2000;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double t = static_cast<double>(i) / intervals;
    const double mu = mu_c + (1.0 - mu_c) * t * t;
    const double weight = (i == 0 || i == intervals) ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * f(mu, fresnel_reflectance(mu, 1.0 / ior)) * 2.0 * (1.0 - mu_c) * t;
  }
  return sum / (3.0 * intervals);
}

}  // namespace

double fresnel_reflectance(double cos_i, double eta) {
  if (eta == 1.0) return 0.0;
  const double sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0) return 1.0;
  const double cos_t = std::sqrt(1.0 - sin2_t);
  const double r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const double r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return 0.5 * (r_s * r_s + r_p * r_p);
}

std::optional<Vec3> refract(const Vec3& d, const Vec3& n, double eta) {
  if (eta == 1.0) return d;
  const double side = d.dot(n) < 0.0 ? 1.0 : -1.0;  // side * n points against d
  const double cos_i = -side * d.dot(n);
  const double sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0) return std::nullopt;
  const Vec3 t = d / eta + (cos_i / eta - std::sqrt(1.0 - sin2_t)) * side * n;
  return t.normalized();
}

Vec3 reflect(const Vec3& d, const Vec3& n) {
  return (d - 2.0 * d.dot(n) * n).normalized();
}

DiffuseReflection diffuse_internal_reflection(double ior) {
  if (ior == 1.0) return {};
  const double mu_c = ior > 1.0 ? std::sqrt(1.0 - 1.0 / (ior * ior)) : 0.0;  // R = 1 below it
  const double R_phi =
      mu_c * mu_c + integrate_above_critical(ior, [](double mu, double R) { return 2.0 * mu * R; });
  const double R_j = mu_c * mu_c * mu_c + integrate_above_critical(ior, [](double mu, double R) {
                       return 3.0 * mu * mu * R;
                     });
  const double R = (R_phi + R_j) / (2.0 - R_phi + R_j);
  return {R, (1.0 + R) / (1.0 - R)};
}

double transmitted_flux_moment(double ior, double c) {
  if (ior == 1.0) return 1.0 + 2.0 * c / 3.0;
  return integrate_above_critical(
      ior, [c](double mu, double R) { return 2.0 * mu * (1.0 - R) * (1.0 + c * mu); });
}

}  // namespace knotlight
