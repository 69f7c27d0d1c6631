#include "reference/first_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

// E: irradiance at right angles to `w` without the object; s: path inside it.
UnscatteredLight attenuated(double E, double s, const Vec3& w, const Medium& medium) {
  const double flux = E * std::exp(-medium.sigma_t() * s);
  return {flux / (4.0 * std::numbers::pi), medium.g * medium.sigma_s * flux * w};
}

}  // namespace

PathLength path_in_sphere(const Vec3& center, double radius) {
  // |x + t d - center| = radius at t = -b +- sqrt(b^2 - c).
  return [center, radius](const Vec3& x, const Vec3& d, double t_max) {
    const double b = (x - center).dot(d);
    const double c = (x - center).squaredNorm() - radius * radius;
    const double root = std::sqrt(std::max(0.0, b * b - c));
    const double begin = std::clamp(-b - root, 0.0, t_max);
    return std::clamp(-b + root, 0.0, t_max) - begin;
  };
}

PathLength path_in_slab(double z_lo, double z_hi) {
  return [z_lo, z_hi](const Vec3& x, const Vec3& d, double t_max) {
    if (d.z() == 0.0) return x.z() >= z_lo && x.z() <= z_hi ? t_max : 0.0;
    const double t1 = (z_lo - x.z()) / d.z();
    const double t2 = (z_hi - x.z()) / d.z();
    return std::clamp(std::max(t1, t2), 0.0, t_max) - std::clamp(std::min(t1, t2), 0.0, t_max);
  };
}

UnscatteredLight first_light_directional(const Vec3& x, const Vec3& direction, double irradiance,
                                         const Medium& medium, const PathLength& path) {
  assert(medium.ior == 1.0);
  const double s = path(x, -direction, std::numeric_limits<double>::infinity());
  return attenuated(irradiance, s, direction, medium);
}

UnscatteredLight first_light_point(const Vec3& x, const Vec3& position, double intensity,
                                   const Medium& medium, const PathLength& path) {
  assert(medium.ior == 1.0);
  const double distance = (x - position).norm();
  const Vec3 w = (x - position) / distance;
  return attenuated(intensity / (distance * distance), path(x, -w, distance), w, medium);
}

}  // namespace knotlight
