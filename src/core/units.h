// Conversions at the border between user and program; inside, angles are radians.
#pragma once

#include <numbers>

namespace knotlight {

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}

}  // namespace knotlight
