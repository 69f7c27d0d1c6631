#include "bkm/kernel_batch.h"

#include <cassert>
#include <cmath>

namespace knotlight {
namespace {

// Below x^2 = 1 series, above it closed forms: the same border, for the same reason, as in
// kernels.cpp, and the same number of terms.
constexpr double series_limit = 1.0;
constexpr int series_terms = 9;

// sinh(x)/x = sum y^k / (2k+1)!, y = x^2, by Horner's rule.
Batch i0_series(const Batch& y) {
  Batch sum = Batch::Ones(y.size());
  for (int k = series_terms; k >= 1; --k) sum = 1.0 + sum * y * (1.0 / (2.0 * k * (2.0 * k + 1.0)));
  return sum;
}

// i_1(x)/x = (1/3) sum of terms with ratio y / (2k (2k+3)), see kernels.cpp.
Batch i1_over_x_series(const Batch& y) {
  Batch sum = Batch::Ones(y.size());
  for (int k = series_terms; k >= 1; --k) sum = 1.0 + sum * y * (1.0 / (2.0 * k * (2.0 * k + 3.0)));
  return sum * (1.0 / 3.0);
}

// exp(x - lambda R) / (2x) and exp(-2x), from which both closed forms are made.
struct Exponentials {
  Batch x, grown, decayed;
};
Exponentials exponentials(const Batch& y, double scale_exponent) {
  Exponentials e;
  e.x = y.sqrt();
  e.grown = (e.x - scale_exponent).exp() / (2.0 * e.x);
  e.decayed = (-2.0 * e.x).exp();
  return e;
}

bool any_small(const Batch& y) {
  return (y < series_limit).any();
}
// Negated, so that not-a-number goes through the closed form.
bool all_small(const Batch& y) {
  return (y < series_limit).all();
}

}  // namespace

PointColumns point_columns(const Points& points) {
  return points.transpose().array();
}

Batch squared_distances(const PointColumns& points, Eigen::Index first, Eigen::Index n,
                        const Vec3& x) {
  assert(n <= batch_size);
  return (points.col(0).segment(first, n) - x.x()).square() +
         (points.col(1).segment(first, n) - x.y()).square() +
         (points.col(2).segment(first, n) - x.z()).square();
}

Batch nonsingular_values(const Batch& s, double lambda, double R) {
  const Batch y = lambda * lambda * s;
  const double scale = std::exp(-lambda * R);
  if (all_small(y)) return scale * i0_series(y);
  const Exponentials e = exponentials(y, lambda * R);
  Batch closed = e.grown * (1.0 - e.decayed);
  if (!any_small(y)) return closed;
  return (y < series_limit).select(scale * i0_series(y), closed);
}

RadialBatch nonsingular_solutions(const Batch& s, double lambda, double R) {
  const Batch y = lambda * lambda * s;
  const double scale = std::exp(-lambda * R);
  // G'(r)/r = lambda^2 i_1(x)/x.
  const double squared = lambda * lambda;
  if (all_small(y)) return {scale * i0_series(y), squared * scale * i1_over_x_series(y)};
  const Exponentials e = exponentials(y, lambda * R);
  const Batch value = e.grown * (1.0 - e.decayed);
  const Batch slope = squared * e.grown * (e.x * (1.0 + e.decayed) - (1.0 - e.decayed)) / y;
  if (!any_small(y)) return {value, slope};
  return {(y < series_limit).select(scale * i0_series(y), value),
          (y < series_limit).select(squared * scale * i1_over_x_series(y), slope)};
}

Batch gaussian_values(const Batch& s, double c) {
  return (s * (-1.0 / (c * c))).exp();
}

RadialBatch gaussians(const Batch& s, double c) {
  const Batch value = gaussian_values(s, c);
  return {value, value * (-2.0 / (c * c))};
}

Batch gaussian_helmholtz_values(const Batch& s, double c, double lambda) {
  const double inverse = 1.0 / (c * c);
  return (4.0 * inverse * inverse * s - (6.0 * inverse + lambda * lambda)) * gaussian_values(s, c);
}

}  // namespace knotlight
