// Vectors and frames. Everything geometric is double precision: the boundary knot method loses its
// solution when distances are rounded to float ([V09] fig. 7.3; tests/bkm/float_distance_test.cpp).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace knotlight {

using Vec3 = Eigen::Vector3d;

// N points as the columns of a 3 x N matrix.
using Points = Eigen::Matrix3Xd;

// One value per colour channel. A scene with one channel keeps it in all three.
using Spectrum = Eigen::Array3d;

// Right-handed orthonormal frame (t, b, n) around the unit vector n.
struct Frame {
  Vec3 t, b, n;

  explicit Frame(const Vec3& unit_n);
  Vec3 to_world(const Vec3& local) const { return local.x() * t + local.y() * b + local.z() * n; }
};

}  // namespace knotlight
