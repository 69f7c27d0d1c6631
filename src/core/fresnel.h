// Reflection and refraction of unpolarised light at a smooth dielectric surface, and the
// hemispherical moments that the diffusion boundary condition needs.
#pragma once

#include <optional>

#include "core/vec3.h"

namespace knotlight {

// Fresnel reflectance (0..1) of unpolarised light. cos_i = |cosine| of the incident angle in the
// medium it comes from; eta = index of the far side over that of the near side. Total internal
// reflection gives 1. [BW99 ch. 1.5]
double fresnel_reflectance(double cos_i, double eta);

// Direction after refraction of the unit direction d (of travel) at the unit normal n (either
// side); eta as above. Nothing on total internal reflection.
std::optional<Vec3> refract(const Vec3& d, const Vec3& n, double eta);

// Mirror direction of the unit direction d (of travel) at the unit normal n.
Vec3 reflect(const Vec3& d, const Vec3& n);

// What internal reflection does to diffuse light leaving an object of relative index `ior`.
struct DiffuseReflection {
  double R = 0.0;  // diffuse internal reflection (Haskell et al. 1994 [H94]), 0..1
  double A = 1.0;  // (1 + R) / (1 - R)
};

// R = (R_phi + R_j) / (2 - R_phi + R_j) with R_phi = int 2 mu R(mu) dmu, R_j = int 3 mu^2 R(mu) dmu
// over (0, 1), R(mu) seen from inside [H94 eq. 2.3.1-2.3.7]. ior = 1 gives A = 1; ior = 1.4 gives
// A = 2.9485. Quadrature error below 1e-8.
DiffuseReflection diffuse_internal_reflection(double ior);

// int 2 mu T(mu) (1 + c mu) dmu over (0, 1), T the Fresnel transmittance from inside: the
// hemispherical flux, over pi, of a leaving radiance T(mu) (1 + c mu). ior = 1: 1 + 2c/3.
double transmitted_flux_moment(double ior, double c);

}  // namespace knotlight
