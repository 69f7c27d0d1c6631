// Conversions at the border between user and program; inside, angles are radians.
#pragma once

#include <cmath>
#include <numbers>

namespace knotlight {

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}

// The linear value (0..1) of a colour value 0..1 coded as pictures and screens have it
// (IEC 61966-2-1, sRGB).
inline double linear_from_srgb(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

}  // namespace knotlight
