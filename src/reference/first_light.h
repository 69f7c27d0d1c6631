// Closed forms of light that has not been scattered yet, in an index-matched object of any shape:
// the ray from the point to the light, and how much of it lies inside.
#pragma once

#include <functional>
#include <limits>

#include "core/medium.h"
#include "core/vec3.h"

namespace knotlight {

// Length inside the object of the ray from `x` (inside or on the surface) along the unit vector
// `d`, up to the distance t_max.
using PathLength = std::function<double(const Vec3& x, const Vec3& d, double t_max)>;

PathLength path_in_sphere(const Vec3& center, double radius);
// The infinite slab z_lo <= z <= z_hi.
PathLength path_in_slab(double z_lo, double z_hi);

struct UnscatteredLight {
  double U_ri = 0.0;         // mean intensity, W/(length^2 sr)
  Vec3 Q_ri = Vec3::Zero();  // g sigma_s F_ri, W/length^3
};

// Beer-Lambert along the ray to the light: radiance concentrated in one direction w, with
//   F_ri = E exp(-sigma_t s) w,  U_ri = |F_ri| / (4 pi),  Q_ri = g sigma_s F_ri
// (docs/theory.md, section 1), s = the path inside the object, E = the irradiance on a surface at
// right angles to w without the object: `irradiance` for a distant light that travels along the
// unit vector `direction`, intensity/distance^2 for a point light. medium.ior must be 1; nothing
// else stands in the way.
UnscatteredLight first_light_directional(const Vec3& x, const Vec3& direction, double irradiance,
                                         const Medium& medium, const PathLength& path);
// `intensity` in W/sr; x must not be `position`.
UnscatteredLight first_light_point(const Vec3& x, const Vec3& position, double intensity,
                                   const Medium& medium, const PathLength& path);

}  // namespace knotlight
