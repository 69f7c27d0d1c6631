// Closed forms of the diffusion equation in a slab: what the whole pipeline is judged against.
#pragma once

#include "reference/p1.h"

namespace knotlight {

// Slab 0 <= z <= thickness between empty half-spaces, of any relative index, lit by a collimated
// beam of irradiance 1 along +z. Both faces reflect as Fresnel says, the beam inside too, however
// often. Fluxes are per irradiance.
class SlabP1 {
 public:
  // sigma_a = 0 is allowed. Throws std::domain_error if sigma_t is within 1e-4 of lambda (they are
  // equal only for (1 - albedo)(1 - g albedo) = 1/3): there the form used here is 0/0.
  SlabP1(const Medium& medium, Boundary boundary, double thickness);

  double U_ri(double z) const;    // W/(length^2 sr)
  double Q_ri_z(double z) const;  // component of Q_ri along +z, W/length^3
  double U_d(double z) const;     // W/(length^2 sr)

  double diffusely_reflected() const;    // diffuse flux out of z = 0
  double diffusely_transmitted() const;  // diffuse flux out of z = thickness
  double unscattered_reflected() const;  // off the lit face, and by the far face back out
  double unscattered_transmitted() const;
  double absorbed() const;  // by first and later interactions
  // Totals; reflected + transmitted + absorbed = 1.
  double reflected() const { return diffusely_reflected() + unscattered_reflected(); }
  double transmitted() const { return diffusely_transmitted() + unscattered_transmitted(); }

 private:
  Medium medium_;
  P1Constants c_;
  double thickness_;
  double face_reflectance_;  // Fresnel, normal incidence, the same from both sides
  double down_, up_;         // irradiance of the beam inside along +z at z = 0, along -z at z = d
  double particular_;        // U_d's part that follows the beams, per irradiance of each
  double even_, odd_;        // and its homogeneous parts, even and odd about the middle
};

// The same slab under diffuse light that enters as boundary data alone (`source: boundary_flux`):
// refracted irradiance 1 through z = 0, and no volume source.
class DiffuseSlabP1 {
 public:
  DiffuseSlabP1(const Medium& medium, Boundary boundary, double thickness);

  double U(double z) const;  // mean intensity of all light inside, W/(length^2 sr)
  double reflected() const;  // fluxes per refracted irradiance; the three add up to 1
  double transmitted() const;
  double absorbed() const;

 private:
  Medium medium_;
  P1Constants c_;
  double thickness_;
  double even_, odd_;
};

}  // namespace knotlight
