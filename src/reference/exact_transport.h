// Slabs of which the transfer equation itself, not diffusion, has been solved.
#pragma once

#include <vector>

namespace knotlight {

// Slab of relative index `ior` under a collimated beam along its normal; Henyey-Greenstein. R and T
// are totals per irradiance (what faces reflect and what passes unscattered included), good to half
// a unit of `digit`. optical_thickness may be infinite.
struct ExactSlab {
  double ior, albedo, optical_thickness, g;
  double R, T;
  double digit;
};

// Index-matched b = 2, albedo 0.9, g = 0.75, and the half-space of index 1.5, albedo 0.9, g = 0:
// the two that the literature on Monte Carlo codes checks against [vdH80] [G55].
const std::vector<ExactSlab>& classic_slabs();

// Converged adding-doubling [vdH80] over the media in which diffusion is used.
const std::vector<ExactSlab>& diffusive_slabs();

}  // namespace knotlight
