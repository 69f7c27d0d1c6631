// The optical coefficients of one translucent material in one colour channel, and everything the
// diffusion equation derives from them. Formulas: docs/theory.md.
#pragma once

namespace knotlight {

// Where the extrapolated boundary lies.
enum class Boundary {
  marshak,  // 2/3 transport mean free paths beyond the surface (P1)
  milne,    // 0.7104, the exact value for a half-space; better pictures
};

struct Medium {
  double sigma_a = 0.0;   // absorption, 1/length
  double sigma_s = 0.0;   // scattering, 1/length
  double g = 0.0;         // mean cosine of the phase function, (-1, 1)
  double ior = 1.0;       // refractive index over that of the outside
  double emission = 0.0;  // E, emitted power density, W/length^3

  double sigma_t() const { return sigma_a + sigma_s; }               // extinction, 1/length
  double sigma_tr() const { return sigma_a + (1.0 - g) * sigma_s; }  // reduced extinction, 1/length
  double albedo() const { return sigma_s / sigma_t(); }              // 0..1
  double reduced_albedo() const { return (1.0 - g) * sigma_s / sigma_tr(); }  // 0..1
  double lambda() const;  // diffusion exponent, 1/length
  // The isotropic medium of the same diffusion coefficients: (sigma_s, g) -> ((1 - g) sigma_s, 0).
  Medium similar() const { return {sigma_a, (1.0 - g) * sigma_s, 0.0, ior, emission}; }
};

// lap U_d - lambda^2 U_d = f,  U_d + k dU_d/dn = (A / (2 pi sigma_tr)) Q_ri . n,  n outward.
struct DiffusionCoefficients {
  double lambda = 0.0;    // 1/length
  double k = 0.0;         // 2 A / (3 sigma_tr), length
  double A = 1.0;         // internal reflection, times 1.0656 for Boundary::milne
  double sigma_tr = 0.0;  // 1/length

  // f = source_per_U_ri * U_ri + source_per_E * E.
  double source_per_U_ri = 0.0;  // -3 sigma_s (sigma_tr + g sigma_t), 1/length^2
  double source_per_E = 0.0;     // -3 sigma_tr / (4 pi), 1/length

  // Right-hand side of the Robin condition, W/(length^2 sr), from Q_ri . n in W/length^3.
  double robin_data(double Q_ri_dot_n) const;
  // Flux leaving through the surface, W/length^2, from U_d there: F_n = 2 pi U_d / A.
  double leaving_flux(double U_d) const;
  // The model that takes light as diffuse from the moment it enters (entered = (1 - R_F) E,
  // W/length^2): right-hand side of the Robin condition for U = U_ri + U_d, and U_ri on the
  // surface.
  double boundary_flux_data(double entered) const;
  static double boundary_flux_U_ri(double entered);
};

DiffusionCoefficients diffusion_coefficients(const Medium& medium, Boundary boundary);

}  // namespace knotlight
