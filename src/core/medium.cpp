#include "core/medium.h"

#include <cmath>
#include <numbers>

#include "core/fresnel.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Extrapolation length of the Milne problem, 0.7104 transport mean free paths [CdH53], over P1's
// 2/3. Scaling A by it everywhere keeps the energy balance (docs/theory.md, "Boundary").
constexpr double milne_over_marshak = 0.7104 / (2.0 / 3.0);

}  // namespace

double Medium::lambda() const {
  return std::sqrt(3.0 * sigma_a * sigma_tr());
}

DiffusionCoefficients diffusion_coefficients(const Medium& m, Boundary boundary) {
  DiffusionCoefficients c;
  c.lambda = m.lambda();
  c.sigma_tr = m.sigma_tr();
  c.A = diffuse_internal_reflection(m.ior).A;
  if (boundary == Boundary::milne) c.A *= milne_over_marshak;
  c.k = 2.0 * c.A / (3.0 * c.sigma_tr);
  c.source_per_U_ri = -3.0 * m.sigma_s * (c.sigma_tr + m.g * m.sigma_t());
  c.source_per_E = -3.0 * c.sigma_tr / (4.0 * pi);
  return c;
}

double DiffusionCoefficients::robin_data(double Q_ri_dot_n) const {
  return A / (2.0 * pi * sigma_tr) * Q_ri_dot_n;
}

double DiffusionCoefficients::leaving_flux(double U_d) const {
  return 2.0 * pi * U_d / A;
}

double DiffusionCoefficients::boundary_flux_data(double entered) const {
  return 0.5 * (1.0 + A) * entered / pi;
}

double DiffusionCoefficients::boundary_flux_U_ri(double entered) {
  return entered / (2.0 * pi);
}

}  // namespace knotlight
