// The functions of kernels.h for up to `batch_size` squared distances at once, in vector
// instructions: a picture asks for some hundred million of them.
#pragma once

#include <Eigen/Core>

#include "core/bkm_choices.h"
#include "core/vec3.h"

namespace knotlight {

// Small enough to stay in the first-level cache, long enough that loop overhead is lost in it.
constexpr Eigen::Index batch_size = 128;

// Up to batch_size numbers, on the stack.
using Batch = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, batch_size, 1>;

// K points with each coordinate contiguous, K x 3: what vector instructions load best.
using PointColumns = Eigen::Array<double, Eigen::Dynamic, 3>;
PointColumns point_columns(const Points& points);

// |p_i - x|^2 of the points first .. first + n - 1; n <= batch_size. In single precision
// coordinates, differences and their squares are float, as in the program of [V09 fig. 7.3 a].
Batch squared_distances(const PointColumns& points, Eigen::Index first, Eigen::Index n,
                        const Vec3& x,
                        DistancePrecision precision = DistancePrecision::double_precision);

// A radial function w(r): gradient of w(|x - p|) = slope * (x - p), without a division by r.
struct RadialBatch {
  Batch value;
  Batch slope;  // w'(r) / r, finite at r = 0
};

// s: squared distances, length^2. Same arguments as in kernels.h.
Batch nonsingular_values(const Batch& s, double lambda, double R);
RadialBatch nonsingular_solutions(const Batch& s, double lambda, double R);

// Non-singular solution of order m [V09 6.8], without its factor sqrt(2/pi) and scaled like order
// 0:
//   U_m = exp(-lambda R) (r / (2 lambda))^m i_m(lambda r) / m!,   (lap - lambda^2) U_m = U_(m-1),
// since (x^m i_m)'' + (2/x) (x^m i_m)' - x^m i_m = 2 m x^(m-1) i_(m-1). Only order 0 solves the
// equation without source. length^(2m); lambda = 0 gives r^(2m) / (2m+1)!. 0 <= order <= max_order.
constexpr int max_order = 4;
Batch nonsingular_values(const Batch& s, double lambda, double R, int order);
RadialBatch nonsingular_solutions(const Batch& s, double lambda, double R, int order);

Batch gaussian_values(const Batch& s, double c);
RadialBatch gaussians(const Batch& s, double c);
Batch gaussian_helmholtz_values(const Batch& s, double c, double lambda);

}  // namespace knotlight
