// Closed form of the diffusion equation in a slab: what the whole pipeline is judged against.
#pragma once

#include "core/medium.h"

namespace knotlight {

// Index-matched slab 0 <= z <= thickness between empty half-spaces, lit by a collimated beam of
// irradiance 1 along +z.
class SlabP1 {
 public:
  // medium.ior must be 1, sigma_a > 0, and lambda differ from sigma_t (they are equal only for
  // (1 - albedo)(1 - g albedo) = 1/3 exactly).
  SlabP1(const Medium& medium, Boundary boundary, double thickness);

  double U_ri(double z) const;  // exp(-sigma_t z) / (4 pi)
  double U_d(double z) const;
  double reflected() const;    // diffuse flux out of z = 0 per irradiance
  double transmitted() const;  // diffuse and unscattered flux out of z = thickness
  double absorbed() const;     // first interactions and diffuse light; the three add up to 1

 private:
  Medium medium_;
  DiffusionCoefficients c_;
  double thickness_;
  double particular_, left_, right_;  // U_d = particular e^(-sigma_t z) + left e^(-lambda z)
                                      //       + right e^(-lambda (thickness - z))
};

}  // namespace knotlight
