#include "core/vec3.h"

#include <cmath>

namespace knotlight {

// Branchless construction without a singular direction [D17].
Frame::Frame(const Vec3& unit_n) : n(unit_n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z());
  const double b_xy = n.x() * n.y() * a;
  t = Vec3(1.0 + sign * n.x() * n.x() * a, sign * b_xy, -sign * n.x());
  b = Vec3(b_xy, sign + n.y() * n.y() * a, -n.y());
}

}  // namespace knotlight
