// Diffuse reflectance of a half-space by a dipole: a point source one transport mean free path
// below the surface, where the light that enters is scattered first, and its mirror image outside,
// which keeps the field near zero on the extrapolated boundary.
#pragma once

#include "core/medium.h"

namespace knotlight {

enum class DipoleForm {
  classic,  // [JMLH01]: all light that is scattered
  better,  // [dE12]: Grosjean's diffusion of what is scattered at least twice; the flux that leaves
           // from fluence and flux of the field, not from the flux alone
};

// Power that leaves per area at distance r from a place where a unit of power has entered,
// 1/length^2:
//
//   R_d(r) = flux [z_r (1 + sigma d_r) exp(-sigma d_r) / d_r^3
//                + z_v (1 + sigma d_v) exp(-sigma d_v) / d_v^3]
//          + fluence [exp(-sigma d_r) / d_r - exp(-sigma d_v) / d_v],
//
//   d_r^2 = r^2 + z_r^2, d_v^2 = r^2 + z_v^2.
struct DipoleKernel {
  double sigma = 0.0;    // diffusion exponent lambda ("sigma_tr" in [JMLH01]), 1/length
  double z_r = 0.0;      // depth of the source, length
  double z_v = 0.0;      // height of its image, length
  double flux = 0.0;     // 1
  double fluence = 0.0;  // 1/length

  // R_d at a squared distance, length^2.
  double operator()(double r2) const;
  // sum powers[i] R_d(sqrt(r2[i])) over n places.
  double sum(const double* r2, const double* powers, int n) const;
  // int R_d dA over the plane: share of the light that enters a half-space which leaves again.
  double total() const;
};

DipoleKernel dipole_kernel(const Medium& medium, DipoleForm form);

}  // namespace knotlight
