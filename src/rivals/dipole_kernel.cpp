#include "rivals/dipole_kernel.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/fresnel.h"

namespace knotlight {

using std::numbers::pi;

DipoleKernel dipole_kernel(const Medium& m, DipoleForm form) {
  const double A = diffuse_internal_reflection(m.ior).A;
  const double albedo = m.reduced_albedo();
  DipoleKernel kernel;
  kernel.z_r = 1.0 / m.sigma_tr();
  if (form == DipoleForm::classic) {
    kernel.sigma = m.lambda();
    kernel.z_v = kernel.z_r * (1.0 + 4.0 * A / 3.0);
    kernel.flux = albedo / (4.0 * pi);
    return kernel;
  }
  // Leaving light is C_phi fluence + C_E flux [dE12], the transmitted moments of an angularly
  // linear radiance: C_phi = int mu T dmu / 2, C_E = 3/2 int mu^2 T dmu over (0, 1).
  const double m0 = transmitted_flux_moment(m.ior, 0.0);
  const double C_phi = 0.25 * m0;
  const double C_E = 0.75 * (transmitted_flux_moment(m.ior, 1.0) - m0);
  const double D = (m.sigma_a + m.sigma_tr()) / (3.0 * m.sigma_tr() * m.sigma_tr());  // [G56]
  kernel.sigma = std::sqrt(m.sigma_a / D);
  kernel.z_v = kernel.z_r + 4.0 * A * D;
  kernel.flux = albedo * albedo * C_E / (4.0 * pi);
  kernel.fluence = albedo * albedo * C_phi / (4.0 * pi * D);
  return kernel;
}

double DipoleKernel::operator()(double r2) const {
  const double one = 1.0;
  return sum(&r2, &one, 1);
}

double DipoleKernel::sum(const double* r2, const double* powers, int n) const {
  using Values = Eigen::ArrayXd;
  const Eigen::Map<const Values> squares(r2, n);
  const Eigen::Map<const Values> weights(powers, n);
  // Each of the two charges; sign: of its fluence.
  const auto charge = [&](double z, double sign) {
    const auto over_d2 = (squares + z * z).inverse();
    return (weights * (-sigma * (squares + z * z).sqrt()).exp() *
            (flux * z * over_d2 * (over_d2.sqrt() + sigma) + sign * fluence * over_d2.sqrt()))
        .sum();
  };
  return charge(z_r, 1.0) + charge(z_v, -1.0);
}

double DipoleKernel::total() const {
  const double apart = z_v - z_r;
  // (exp(-sigma z_r) - exp(-sigma z_v)) / sigma, which is z_v - z_r without absorption.
  const double decrease =
      sigma > 0.0 ? -std::exp(-sigma * z_r) * std::expm1(-sigma * apart) / sigma : apart;
  return 2.0 * pi * (flux * (std::exp(-sigma * z_r) + std::exp(-sigma * z_v)) + fluence * decrease);
}

}  // namespace knotlight
