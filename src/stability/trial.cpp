#include "stability/trial.h"

#include <cmath>

namespace knotlight {

ExactField outer_source(const std::string& name, const Vec3& y, const Vec3& foot, double lambda) {
  const double nearest = (foot - y).norm();
  return {name,
          [=](const Vec3& x) {
            const double r = (x - y).norm();
            return std::exp(-lambda * (r - nearest)) * nearest / r;
          },
          [=](const Vec3& x) -> Vec3 {
            const Vec3 d = x - y;
            const double r = d.norm();
            return -(lambda + 1.0 / r) * std::exp(-lambda * (r - nearest)) * nearest / (r * r) * d;
          }};
}

ExactField decaying_layer(const Vec3& w, double s) {
  return {"layer", [=](const Vec3& x) { return std::exp(s * (w.dot(x) - 1.0)); },
          [=](const Vec3& x) -> Vec3 { return s * std::exp(s * (w.dot(x) - 1.0)) * w; }};
}

DiffusionScale scale_of(const Body& body, double lambda_R, double albedo) {
  DiffusionScale m;
  m.lambda = lambda_R / body.half_extent;
  m.sigma_tr = m.lambda / std::sqrt(3.0 * (1.0 - albedo));
  m.k = 2.0 / (3.0 * m.sigma_tr);
  return m;
}

BoundaryCase source_case(const Body& body, double lambda_R, double albedo,
                         const std::vector<double>& noises, std::uint64_t seed) {
  const DiffusionScale m = scale_of(body, lambda_R, albedo);
  const Vec3 foot = body.foot.position, n = body.foot.normal;
  return {&body,
          m.lambda,
          m.k,
          {outer_source("near", foot + n / m.sigma_tr, foot, m.lambda),
           outer_source("far", foot + body.half_extent * n, foot, m.lambda)},
          noises,
          seed};
}

}  // namespace knotlight
