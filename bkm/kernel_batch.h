// The functions of kernels.h for up to `batch_size` squared distances at once, in vector
// instructions: a picture asks for some hundred million of them.
#pragma once

#include <Eigen/Core>

#include "core/vec3.h"

namespace knotlight {

// Small enough to stay in the first-level cache, long enough that loop overhead is lost in it.
constexpr Eigen::Index batch_size = 128;

// Up to batch_size numbers, on the stack.
using Batch = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, batch_size, 1>;

// K points with each coordinate contiguous, K x 3: what vector instructions load best.
using PointColumns = Eigen::Array<double, Eigen::Dynamic, 3>;
PointColumns point_columns(const Points& points);

// |p_i - x|^2 of the points first .. first + n - 1; n <= batch_size.
Batch squared_distances(const PointColumns& points, Eigen::Index first, Eigen::Index n,
                        const Vec3& x);

// A radial function w(r): gradient of w(|x - p|) = slope * (x - p), without a division by r.
struct RadialBatch {
  Batch value;
  Batch slope;  // w'(r) / r, finite at r = 0
};

// s: squared distances, length^2. Same arguments as in kernels.h.
Batch nonsingular_values(const Batch& s, double lambda, double R);
RadialBatch nonsingular_solutions(const Batch& s, double lambda, double R);
Batch gaussian_values(const Batch& s, double c);
RadialBatch gaussians(const Batch& s, double c);
Batch gaussian_helmholtz_values(const Batch& s, double c, double lambda);

}  // namespace knotlight
