// How much of a ball, or of a radial kernel, lies inside an object: what a density estimate near a
// boundary divides by.
#pragma once

#include <cstdint>

#include "core/vec3.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Radial weight K(s) of a density estimate, s = distance/radius in [0, 1).
enum class RadialKernel {
  ball,    // 1
  smooth,  // (1 - s^2)^2: falls to 0 with its slope, so sums over evenly spread points err least
};
double kernel_value(RadialKernel kernel, double s_squared);

// Integrals over the part of the ball around x that lies inside the object.
struct KernelMoments {
  double mass = 0.0;          // int K(|u|/r) dV, length^3
  Vec3 first = Vec3::Zero();  // int K(|u|/r) u dV, u = position - x, length^4
};

// For x inside the object or on its surface. Exact if the surface is further than r; otherwise
// summed over a fixed set of lines through x, exact along each line: 32 lines arranged around the
// normal where the surface looks alike all around it, 256 elsewhere. Errors of the mass in parts of
// the whole ball's: tests/photon/ball_volume_test.cpp.
KernelMoments kernel_moments_inside(const Vec3& x, double r, RadialKernel kernel,
                                    const RayCaster& caster, std::uint32_t object);

// Volume of the part of the ball that lies inside the object, length^3.
double ball_volume_inside(const Vec3& x, double r, const RayCaster& caster, std::uint32_t object);

}  // namespace knotlight
