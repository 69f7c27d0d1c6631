#include "core/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knotlight {

using std::numbers::pi;

Vec3 sample_sphere(double u, double v) {
  return sample_cone(u, v, -1.0);
}

Vec3 sample_cosine_hemisphere(double u, double v) {
  const Eigen::Vector2d p = sample_disc(u, v);
  return {p.x(), p.y(), std::sqrt(std::max(0.0, 1.0 - p.squaredNorm()))};
}

Vec3 sample_cone(double u, double v, double cos_max) {
  const double one_minus_cos = u * (1.0 - cos_max);  // keeps its digits for narrow cones
  const double sin_theta = std::sqrt(std::max(0.0, one_minus_cos * (2.0 - one_minus_cos)));
  const double phi = 2.0 * pi * v;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1.0 - one_minus_cos};
}

Eigen::Vector2d sample_disc(double u, double v) {
  const double x = 2.0 * u - 1.0;
  const double y = 2.0 * v - 1.0;
  if (x == 0.0 && y == 0.0) return {0.0, 0.0};
  const bool wide = std::abs(x) > std::abs(y);
  const double r = wide ? x : y;
  const double phi = wide ? (pi / 4.0) * (y / x) : (pi / 2.0) - (pi / 4.0) * (x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

Eigen::Vector2d sample_triangle(double u, double v) {
  const double root = std::sqrt(u);
  return {1.0 - root, v * root};
}

double sample_free_flight(double u, double sigma_t) {
  return -std::log1p(-u) / sigma_t;
}

}  // namespace knotlight
