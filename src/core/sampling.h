// Samplers of directions and areas. Each comment gives the density of what comes out and its
// measure; tests/core/sampling_test.cpp checks normalisation, mean and a chi-square for each.
// u, v are independent uniforms in [0, 1).
#pragma once

#include "core/vec3.h"

namespace knotlight {

// Unit vectors, density 1/(4 pi) per solid angle.
Vec3 sample_sphere(double u, double v);

// Unit vectors around +z, density cos(theta)/pi per solid angle.
Vec3 sample_cosine_hemisphere(double u, double v);

// Unit vectors with cos(theta) in [cos_max, 1] around +z, density 1/(2 pi (1 - cos_max)) per solid
// angle.
Vec3 sample_cone(double u, double v, double cos_max);

// Points of the unit disc, density 1/pi per area (concentric map, Shirley & Chiu 1997 [SC97]).
Eigen::Vector2d sample_disc(double u, double v);

// Barycentric coordinates (b1, b2) of a triangle, density 1/area per area.
Eigen::Vector2d sample_triangle(double u, double v);

// Distance to the next interaction, density sigma_t exp(-sigma_t s) per length [V09 6.18].
double sample_free_flight(double u, double sigma_t);

}  // namespace knotlight
