#include "reference/p1.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fresnel.h"

namespace knotlight {
namespace {

// Two derivations and two quadratures of the same constants.
TEST(P1Constants, AgreeWithTheSolvers) {
  for (const Boundary boundary : {Boundary::marshak, Boundary::milne})
    for (const double g : {0.0, 0.8, -0.3})
      for (const double ior : {1.0, 1.33, 1.6, 0.8}) {
        const Medium medium{0.3, 7.0, g, ior, 0.0};
        const P1Constants own = p1_constants(medium, boundary);
        const DiffusionCoefficients theirs = diffusion_coefficients(medium, boundary);
        constexpr double rounding = 1e-13, quadrature = 1e-6;  // relative
        EXPECT_NEAR(own.lambda / theirs.lambda, 1.0, rounding);
        EXPECT_NEAR(own.per_U_ri / theirs.source_per_U_ri, 1.0, rounding);
        EXPECT_NEAR(own.per_E / theirs.source_per_E, 1.0, rounding);
        EXPECT_NEAR(own.A / theirs.A, 1.0, quadrature) << ior;
        EXPECT_NEAR(own.k / theirs.k, 1.0, quadrature);
        EXPECT_NEAR(own.per_Q / theirs.robin_data(1.0), 1.0, quadrature);
        EXPECT_NEAR(own.out_per_U / theirs.leaving_flux(1.0), 1.0, quadrature);
      }
}

TEST(P1Constants, KnownInternalReflection) {
  EXPECT_EQ(internal_reflection_A(1.0), 1.0);
  EXPECT_NEAR(internal_reflection_A(1.4), 2.9485, 5e-5);
}

TEST(P1Constants, ReflectanceFromInside) {
  for (const double angle : {0.0, 1e-7, 0.3, 0.7, 0.79})
    EXPECT_NEAR(reflectance_from_inside(angle, 1.4),
                fresnel_reflectance(std::cos(angle), 1.0 / 1.4), 1e-12);
  EXPECT_EQ(reflectance_from_inside(0.8, 1.4), 1.0);
}

}  // namespace
}  // namespace knotlight
