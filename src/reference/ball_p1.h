// Closed forms of the diffusion equation in a ball, of any relative index.
#pragma once

#include "reference/p1.h"

namespace knotlight {

// A ball that emits uniformly (medium.emission) and that no other light reaches. sigma_a = 0 is
// allowed.
class GlowingBallP1 {
 public:
  GlowingBallP1(const Medium& medium, Boundary boundary, double radius);

  double U_d(double r) const;    // at the distance r from the centre, W/(length^2 sr)
  double power_leaving() const;  // W
  double power_absorbed() const;

 private:
  Medium medium_;
  P1Constants c_;
  double radius_;
};

// A lamp in the centre of a ball: an isotropic point source of total power 1 W, which starts inside
// the medium. Light that reaches the surface unscattered and is reflected there is left out of the
// source: at most fresnel_reflectance(1, ior) e^(-sigma_t radius) of the power, none for ior 1.
class LampInBallP1 {
 public:
  // sigma_a > 0. Throws std::domain_error unless lambda < sigma_t (true for reduced albedos of 2/3
  // and more, whatever g).
  LampInBallP1(const Medium& medium, Boundary boundary, double radius);

  double U_ri(double r) const;    // r > 0, W/(length^2 sr)
  double U_d(double r) const;     // infinite at r = 0, as a logarithm or, for g > 0, as 1/r
  double power_leaving() const;   // diffuse, W
  double power_absorbed() const;  // of the diffuse light: scattered in - leaving
  double power_in() const;        // that interacts, W

 private:
  struct Value {
    double u, slope;
  };
  Value particular(double r) const;

  Medium medium_;
  P1Constants c_;
  double radius_;
  double homogeneous_;  // amplitude of sinh(lambda r) / (lambda r)
};

}  // namespace knotlight
