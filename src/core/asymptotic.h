// What is known exactly about isotropic scattering, where the diffusion approximation only comes
// near: the field of a point source in an infinite medium.
// Formulas: docs/theory.md, "Beyond P1".
#pragma once

#include <vector>

#include "core/medium.h"

namespace knotlight {

// The mean intensity of a point source of unit power over 4 pi in an infinite medium is, exactly
// [CdH53],
//
//   strength sigma_t exp(-kappa r) / (4 pi r) + epsilon(sigma_t r) exp(-sigma_t r) / (4 pi r^2):
//
// an asymptotic part that obeys a diffusion equation, and a transient one within a few mean free
// paths. P1 has kappa = sqrt(3 sigma_a sigma_t), strength 3 and no transient part.
class PointSourceField {
 public:
  // The exact field; albedo in [0, 1].
  static PointSourceField exact(double albedo);
  // Grosjean's approximation [G56]: kappa^2 = 3 (1 - albedo) / (2 - albedo), strength 3 albedo / (2
  // - albedo), epsilon = 1.
  static PointSourceField grosjean(double albedo);

  // In 1/mean free path: the root of albedo atanh(kappa) = kappa in [0, 1].
  double kappa() const { return kappa_; }
  // -d kappa^2 / d albedo; 3 without absorption, 0 without scattering.
  double strength() const { return strength_; }
  // At a distance in mean free paths; 1 at 0. Error below 1e-3.
  double epsilon(double distance) const;

 private:
  PointSourceField() = default;

  double kappa_ = 0.0, strength_ = 0.0;
  std::vector<double> epsilon_;  // tabulated
};

// The medium whose P1 equation has the asymptotic part as its solution: lambda = kappa, sigma_tr =
// sigma_t, emission in proportion. Isotropic scattering only. The power of its sources has to be
// multiplied by asymptotic_power.
Medium asymptotic_medium(const Medium& medium, const PointSourceField& field);
double asymptotic_power(const Medium& medium, const PointSourceField& field);

}  // namespace knotlight
