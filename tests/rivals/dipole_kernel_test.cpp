#include "rivals/dipole_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/fresnel.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr DipoleForm forms[] = {DipoleForm::classic, DipoleForm::better};

// sigma_tr = 1 / mean_free_path whatever g.
Medium medium(double reduced_albedo, double ior = 1.0, double g = 0.0) {
  const double sigma_tr = 2.5;
  return {(1.0 - reduced_albedo) * sigma_tr, reduced_albedo * sigma_tr / (1.0 - g), g, ior, 0.0};
}

// alpha'/2 (1 + exp(-4/3 A s)) exp(-s), s = sqrt(3 (1 - alpha')) [JMLH01].
TEST(DipoleKernel, TotalReflectanceOfTheClassicForm) {
  for (const double ior : {1.0, 1.3, 1.5})
    for (const double albedo : {0.2, 0.8, 0.99, 0.9999})
      for (const double g : {0.0, 0.7}) {
        const double A = diffuse_internal_reflection(ior).A;
        const double s = std::sqrt(3.0 * (1.0 - albedo));
        const double expected = 0.5 * albedo * (1.0 + std::exp(-4.0 / 3.0 * A * s)) * std::exp(-s);
        const DipoleKernel kernel = dipole_kernel(medium(albedo, ior, g), DipoleForm::classic);
        EXPECT_NEAR(kernel.total(), expected, 1e-12) << ior << " " << albedo << " " << g;
      }
}

// int R_d 2 pi r dr with r = exp(t), a trapezium sum, which converges geometrically for a smooth
// integrand that dies off on both sides. Without absorption the tail falls as 1/r only: there the
// limit below has to do.
TEST(DipoleKernel, TotalIsTheIntegralOverThePlane) {
  for (const DipoleForm form : forms)
    for (const double ior : {1.0, 1.4})
      for (const double albedo : {0.3, 0.95}) {
        const DipoleKernel kernel = dipole_kernel(medium(albedo, ior), form);
        double sum = 0.0;
        constexpr double step = 0.02;
        for (double t = -20.0; t < 8.0; t += step)
          sum += 2.0 * pi * std::exp(2.0 * t) * kernel(std::exp(2.0 * t)) * step;
        EXPECT_NEAR(sum, kernel.total(), 1e-9) << ior << " " << albedo;
      }
}

// What is not absorbed leaves, whatever the surface reflects inside; what only absorbs returns
// nothing.
TEST(DipoleKernel, LimitsOfTheAlbedo) {
  for (const DipoleForm form : forms)
    for (const double ior : {1.0, 1.4}) {
      // The quadrature of the Fresnel moments errs by 1e-8.
      EXPECT_NEAR(dipole_kernel(medium(1.0, ior), form).total(), 1.0, 1e-7);
      EXPECT_NEAR(dipole_kernel(medium(1.0 - 1e-12, ior), form).total(), 1.0, 1e-4);
      EXPECT_EQ(dipole_kernel(medium(0.0, ior), form).total(), 0.0);
      EXPECT_EQ(dipole_kernel(medium(0.0, ior), form)(0.3), 0.0);
    }
}

// Fluence of a unit source at depth z_r and its image, by differences: the flux through the surface
// is D d phi / dz, and the better form takes phi / 4 + flux / 2 of it where nothing is reflected.
TEST(DipoleKernel, IsTheLeavingLightOfTwoCharges) {
  for (const DipoleForm form : forms) {
    const Medium m = medium(0.9);
    const DipoleKernel kernel = dipole_kernel(m, form);
    const bool classic = form == DipoleForm::classic;
    const double sigma_tr = m.sigma_tr();
    const double D = classic ? 1.0 / (3.0 * sigma_tr)
                             : (2.0 * m.sigma_a + m.sigma_s) / (3.0 * sigma_tr * sigma_tr);
    const double exponent = std::sqrt(m.sigma_a / D);
    const double z_r = 1.0 / sigma_tr;
    const double z_v = z_r + 4.0 * D;
    const auto charge = [&](double d) { return std::exp(-exponent * d) / (4.0 * pi * D * d); };
    const auto fluence = [&](double r, double z) {  // z is depth
      return charge(std::hypot(r, z - z_r)) - charge(std::hypot(r, z + z_v));
    };
    for (const double r : {0.0, 0.3, 2.0}) {
      constexpr double step = 1e-5;
      const double flux = D * (fluence(r, step) - fluence(r, -step)) / (2.0 * step);
      const double leaving = classic ? 0.9 * flux : 0.81 * (fluence(r, 0.0) / 4.0 + flux / 2.0);
      EXPECT_NEAR(kernel(r * r), leaving, 1e-7 * leaving) << r;
    }
  }
}

TEST(DipoleKernel, SumsManyPlacesAsOneByOne) {
  const DipoleKernel kernel = dipole_kernel(medium(0.97, 1.4), DipoleForm::better);
  std::vector<double> squares, powers;
  double expected = 0.0;
  for (int i = 0; i < 37; ++i) {
    squares.push_back(0.01 * i * i);
    powers.push_back(1.0 + i % 5);
    expected += powers.back() * kernel(squares.back());
  }
  EXPECT_NEAR(kernel.sum(squares.data(), powers.data(), 37), expected, 1e-13 * expected);
}

}  // namespace
}  // namespace knotlight
