#include "render/exitance.h"

#include <gtest/gtest.h>

#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Hemispherical flux of the leaving radiance by the midpoint rule in the cosine outside.
double flux(const LeavingRadiance& leaving, double U_d) {
  constexpr int cells = 20'000;
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double mu = (i + 0.5) / cells;
    sum += 2.0 * pi * mu * leaving(U_d, mu) / cells;
  }
  return sum;
}

// Whatever the angular form, what leaves is F_n = 2 pi U_d / A (midpoint error below 1e-6).
TEST(LeavingRadiance, CarriesTheFluxOfTheBoundaryCondition) {
  for (const double ior : {1.0, 1.3, 1.6})
    for (const Boundary boundary : {Boundary::marshak, Boundary::milne})
      for (const Exitance model : {Exitance::p1, Exitance::lambert}) {
        const Medium medium{0.1, 10.0, 0.3, ior, 0.0};
        const DiffusionCoefficients c = diffusion_coefficients(medium, boundary);
        const double F_n = c.leaving_flux(0.7);
        EXPECT_NEAR(flux(LeavingRadiance(ior, c.A, model), 0.7), F_n, 2e-6 * F_n)
            << ior << ' ' << static_cast<int>(boundary) << ' ' << static_cast<int>(model);
      }
}

// P1 with matched indices: L = U_d (1 + 3/2 mu).
TEST(LeavingRadiance, P1FormWithoutAnIndexStep) {
  const LeavingRadiance leaving(1.0, 1.0, Exitance::p1);
  for (const double mu : {0.1, 0.5, 1.0})
    EXPECT_NEAR(leaving(2.0, mu), 2.0 * (1.0 + 1.5 * mu), 1e-12);
}

TEST(LeavingRadiance, MeanIntensityIsTheThesis) {
  const LeavingRadiance leaving(1.4, 2.9485, Exitance::mean_intensity);
  EXPECT_EQ(leaving(0.3, 0.2), 0.3);
}

// A refracting surface sends out nothing at grazing angles.
TEST(LeavingRadiance, FresnelDarkensGrazingAngles) {
  const LeavingRadiance leaving(1.4, 2.9485, Exitance::lambert);
  EXPECT_LT(leaving(1.0, 1e-4), 1e-3 * leaving(1.0, 1.0));
}

}  // namespace
}  // namespace knotlight
