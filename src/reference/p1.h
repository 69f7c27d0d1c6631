// The constants of the P1 equations, derived here a second time. The solvers take theirs from
// core/medium.h; if the closed forms did too, a wrong factor there would be wrong on both sides of
// every comparison and never be seen.
#pragma once

#include "core/medium.h"

namespace knotlight {

// lap U_d - lambda^2 U_d = per_U_ri U_ri + per_E E,   U_d + k dU_d/dn = per_Q Q_ri . n (n outward),
// flux out = out_per_U U_d.
struct P1Constants {
  double lambda;     // 1/length
  double k;          // length
  double A;          // internal reflection, times 1.0656 for Boundary::milne
  double per_U_ri;   // 1/length^2
  double per_E;      // 1/length
  double per_Q;      // length/sr
  double out_per_U;  // sr
};

P1Constants p1_constants(const Medium& medium, Boundary boundary);

// Reflectance of a smooth face for unpolarised light inside that meets it at the angle `inside`
// (radians) from its normal; 1 beyond the critical angle. [BW99 ch. 1.5]
double reflectance_from_inside(double inside, double ior);

// A = (1 + R) / (1 - R) of the same face for diffuse light [H94].
double internal_reflection_A(double ior);

}  // namespace knotlight
