#include "bkm/kernel_batch.h"

#include <cassert>
#include <cmath>

#include "bkm/factorial.h"
#include "bkm/kernels.h"

namespace knotlight {
namespace {

// Below x^2 = 1 series, above it closed forms: the border of kernels.h, whose square it is too.

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

// h_m(x) = i_m(x) / x^m times exp(-lambda R), y = x^2. Below `upward_limit` by the power series
//   h_m = 1/(2m+1)!! sum_k (y/2)^k / (k! (2m+3)(2m+5)...(2m+2k+1)),
// all of whose terms are positive; above it by the recurrence i_(m+1) = i_(m-1) - (2m+1)/x i_m
// upwards from the closed forms. At x = 8 the recurrence up to m = 5 loses a factor 40 of rounding.
constexpr double upward_limit = 64.0;
constexpr int upward_terms = 40;  // at y = 64 the first one left out is 1e-20 of the sum

Batch bessel_quotient_series(const Batch& y, int m) {
  Batch sum = Batch::Ones(y.size());
  for (int k = upward_terms; k >= 1; --k)
    sum = 1.0 + sum * y * (1.0 / (2.0 * k * (2.0 * k + 2.0 * m + 1.0)));
  return sum * (1.0 / double_factorial(2 * m + 1));
}

Batch bessel_quotient(const Batch& y, int m, double scale_exponent) {
  Batch series = std::exp(-scale_exponent) * bessel_quotient_series(y.min(upward_limit), m);
  // Negated, so that not-a-number goes through the closed form.
  if ((y < upward_limit).all()) return series;
  const Exponentials e = exponentials(y, scale_exponent);
  Batch below = e.grown * (1.0 - e.decayed);                              // h_0
  Batch h = e.grown * (e.x * (1.0 + e.decayed) - (1.0 - e.decayed)) / y;  // h_1
  if (m == 0) return (y < upward_limit).select(series, below);
  for (int k = 1; k < m; ++k) {
    const Batch above = (below - (2.0 * k + 1.0) * h) / y;
    below = h;
    h = above;
  }
  return (y < upward_limit).select(series, h);
}

// (s/2)^m / m!
Batch power_term(const Batch& s, int m) {
  Batch power = Batch::Constant(s.size(), 1.0 / factorial(m));
  for (int k = 0; k < m; ++k) power *= 0.5 * s;
  return power;
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
                        const Vec3& x, DistancePrecision precision) {
  assert(n <= batch_size);
  if (precision == DistancePrecision::single_precision) {
    using Floats = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, batch_size, 1>;
    Floats sum = Floats::Zero(n);
    for (int axis = 0; axis < 3; ++axis) {
      const float coordinate = static_cast<float>(x(axis));
      const Floats column = points.col(axis).segment(first, n).cast<float>();
      sum += (column - coordinate).square();
    }
    const Batch r = sum.sqrt().cast<double>();  // what the program handed on was the distance
    return r.square();
  }
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

Batch nonsingular_values(const Batch& s, double lambda, double R, int order) {
  assert(order >= 0 && order <= max_order);
  if (order == 0) return nonsingular_values(s, lambda, R);
  return power_term(s, order) * bessel_quotient(lambda * lambda * s, order, lambda * R);
}

// With g_m = x^m i_m: g_m' = 2 m x^(m-1) i_m + x^m i_(m+1), both terms positive.
RadialBatch nonsingular_solutions(const Batch& s, double lambda, double R, int order) {
  assert(order >= 0 && order <= max_order);
  if (order == 0) return nonsingular_solutions(s, lambda, R);
  const Batch y = lambda * lambda * s;
  const Batch h = bessel_quotient(y, order, lambda * R);
  const Batch next = bessel_quotient(y, order + 1, lambda * R);
  const Batch power = power_term(s, order);
  return {power * h, power_term(s, order - 1) * h + lambda * lambda * power * next};
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
