// What a half-space that scatters and absorbs gives back of the light that falls on it, exactly:
// the transfer equation is solved, no diffusion. The phase function is Henyey-Greenstein's; the
// surface does not reflect or refract. Formulas: [Ch60 ch. III, IV]; how they are solved:
// half_space_mode.h.
#pragma once

#include <vector>

namespace knotlight {

// Radiance that leaves a half-space per irradiance on its surface (1/sr), tabulated for one medium.
// mu and mu0 in (0, 1] are the cosines of the leaving and of the arriving light with the outward
// normal. cos_phi in [-1, 1] is the cosine of the azimuth between both directions of travel,
// projected on the surface: 1 goes on forwards. The leaving radiance is rho E, the irradiance E
// including its factor mu0. Both rho are symmetric in mu and mu0.
class HalfSpaceReflection {
 public:
  // albedo in [0, 1], |g| < 1. Takes 1 ms for g = 0, 2 ms for 0.8, 30 ms for 0.95 and beyond.
  // Error of `multiple` in parts of itself, mu and mu0 above 0.01: at most 1e-3 for g = -0.5 ..
  // 0.8; 5e-3 for g = 0.9, 6e-2 for 0.95 and 3e-2 for -0.8, all at grazing angles straight on or
  // straight back (root mean square over all angles, in parts of all light: 5e-4). Peaks of a
  // larger |g| are blurred.
  HalfSpaceReflection(double albedo, double g);

  // Light scattered at least twice. 0.1 microseconds.
  double multiple(double mu, double mu0, double cos_phi) const;
  // Light scattered once: albedo p(Theta) / (mu + mu0), in closed form [Ch60 ch. III].
  double single(double mu, double mu0, double cos_phi) const;

 private:
  double albedo_, g_;
  double peak_;               // of single / albedo: what a forward peak adds to the table
  int angles_;                // of azimuth in the table: 1 if nothing depends on it
  std::vector<float> table_;  // (mu + mu0) multiple at [mu][mu0][azimuth]
};

}  // namespace knotlight
