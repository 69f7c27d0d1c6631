// The radial functions of dual reciprocity [V09 tab. 5.1, 6.8]: psi, chosen first, and its image
// phi = (lap - lambda^2) psi, derived in closed form [V09 5.22, 6.15], for up to `batch_size`
// distances at once.
//
// phi must be finite at r = 0. lap r = 2/r, lap (1 - r)^2 = 6 - 4/r and lap (r^2 log r) = 6 log r +
// 5 are not, so for these three, and for r^3, which would else be the partner of r once more, the
// table's function is lap psi instead of psi: what approximates the source is then, but for the
// small lambda^2 psi, the function of the table, and u_p is two orders smoother. With q = r/c:
//
//   linear      lap psi = q           psi = q^3 / 12
//   cubic       lap psi = q^3         psi = q^5 / 30
//   thin_plate  lap psi = q^2 log q   psi = q^4 log q / 20 - 9 q^4 / 400
//   compact_c0  lap psi = (1 - q)+^2  psi = q^2/6 - q^3/6 + q^4/20 - 1/12, beyond q = 1: -1/(30 q)
//
// The others are psi themselves:
//
//   gaussian              exp(-q^2)
//   multiquadric          (1 + q^2)^(b/2)
//   inverse_multiquadric  (1 + q^2)^(-b/2)
//   compact_c2            (1 - q)+^4 (4 q + 1)
//   compact_c4            (1 - q)+^6 (35 q^2 + 18 q + 3)
//   nonsingular           U_m, m >= 1: phi = U_(m-1), see kernel_batch.h
//
// No polynomial is appended, neither here nor in the thesis.
#pragma once

#include "bkm/kernel_batch.h"
#include "core/bkm_choices.h"

namespace knotlight {

struct RadialFunction {
  RadialKind kind = RadialKind::gaussian;
  double c = 1.0;         // > 0, length: width, radius of the support, or just unit of length
  double exponent = 1.0;  // b > 0 of the two multiquadrics
  int order = 1;          // m of nonsingular; 0 is allowed too: phi = 0, the basis of u_h
  double lambda = 1.0;    // >= 0, 1/length
  double R = 1.0;         // scale of nonsingular, length
};

// s: squared distances, length^2; w(r) and w'(r)/r as in kernel_batch.h. Not-a-number stays.
Batch psi_values(const RadialFunction& w, const Batch& s);
RadialBatch psi_with_slopes(const RadialFunction& w, const Batch& s);
// psi has no unit (nonsingular: length^(2m)), phi is psi per length^2.
Batch phi_values(const RadialFunction& w, const Batch& s);

}  // namespace knotlight
