// The diffusion equation in a ball under a beam: no closed form, but a Legendre series whose radial
// parts are solved to many digits, by means that share nothing with the solvers under test.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/vec3.h"
#include "reference/p1.h"

namespace knotlight {

// Index-matched ball around the origin, lit by a beam of irradiance 1 that travels along -z.
class SphereBeamP1 {
 public:
  // medium.ior must be 1 (std::domain_error). sigma_a = 0 is allowed. Takes 0.1 to 0.5 s.
  SphereBeamP1(const Medium& medium, Boundary boundary, double radius);

  double U_ri(const Vec3& x) const;  // |x| <= radius, W/(length^2 sr)
  double U_d(
      const Vec3& x) const;       // |x| <= radius, W/(length^2 sr); error below 1e-5 of its largest
  double power_in() const;        // that interacts, W
  double power_leaving() const;   // diffuse, W
  double power_absorbed() const;  // of the diffuse light, W

 private:
  double path_from_entry(double r, double mu) const;

  Medium medium_;
  P1Constants c_;
  double radius_;
  std::vector<double> borders_;     // of the radial elements, 0 to radius
  std::vector<Eigen::VectorXd> u_;  // per Legendre degree: values at the radial nodes
};

}  // namespace knotlight
