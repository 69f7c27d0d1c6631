#include "core/medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Worked by hand: sigma_a = 0.5, sigma_s = 10, g = 0.8.
TEST(Medium, DerivedCoefficients) {
  const Medium m{0.5, 10.0, 0.8, 1.0, 0.0};
  EXPECT_DOUBLE_EQ(m.sigma_t(), 10.5);
  EXPECT_NEAR(m.sigma_tr(), 2.5, 1e-14);
  EXPECT_NEAR(m.lambda(), std::sqrt(3.75), 1e-14);
  EXPECT_NEAR(m.albedo(), 10.0 / 10.5, 1e-15);
  EXPECT_NEAR(m.reduced_albedo(), 0.8, 1e-14);
}

TEST(Medium, DiffusionCoefficients) {
  const Medium m{0.5, 10.0, 0.8, 1.0, 0.0};
  const DiffusionCoefficients c = diffusion_coefficients(m, Boundary::marshak);
  EXPECT_NEAR(c.k, 2.0 / 7.5, 1e-14);
  EXPECT_NEAR(c.source_per_U_ri, -3.0 * 10.0 * (2.5 + 0.8 * 10.5), 1e-11);
  EXPECT_NEAR(c.source_per_E, -7.5 / (4.0 * pi), 1e-13);
  EXPECT_NEAR(c.robin_data(3.0), 3.0 / (2.0 * pi * 2.5), 1e-14);
  EXPECT_NEAR(c.leaving_flux(1.0), 2.0 * pi, 1e-14);
}

// Extrapolation length: k is 0.7104 transport mean free paths with Boundary::milne, 2/3 without,
// and the flux that leaves scales so that F_n k / U_d stays 4 pi / (3 sigma_tr).
TEST(Medium, MilneKeepsTheBalance) {
  const Medium m{0.1, 4.9, 0.0, 1.4, 0.0};
  const DiffusionCoefficients p1 = diffusion_coefficients(m, Boundary::marshak);
  const DiffusionCoefficients milne = diffusion_coefficients(m, Boundary::milne);
  EXPECT_NEAR(milne.k / p1.k, 0.7104 * 1.5, 1e-12);
  EXPECT_NEAR(milne.leaving_flux(1.0) * milne.k, 4.0 * pi / (3.0 * m.sigma_tr()), 1e-12);
  EXPECT_NEAR(p1.leaving_flux(1.0) * p1.k, 4.0 * pi / (3.0 * m.sigma_tr()), 1e-12);
  EXPECT_NEAR(p1.A, 2.9485, 5e-5);
}

}  // namespace
}  // namespace knotlight
