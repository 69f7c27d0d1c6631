#include "reference/slab_p1.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace knotlight {
namespace {

// The same closed form by another program, to the six digits it printed: thickness 1, boundary
// marshak, totals.
struct Case {
  double ior, albedo, optical_thickness, g, R, T, U_front, U_middle, U_back;
};
constexpr Case cases[] = {
    {1.0, 0.9, 2, 0, 0.370523, 0.367873, 0.0589706, 0.0796923, 0.0370095},
    {1.0, 0.9, 10, 0, 0.425951, 0.00524542, 0.0677921, 0.0221154, 0.000827608},
    {1.0, 0.99, 2, 0, 0.495717, 0.471224, 0.0788959, 0.111827, 0.0534584},
    {1.0, 0.99, 10, 0, 0.744501, 0.0854638, 0.118491, 0.132648, 0.0135948},
    {1.0, 0.99, 20, 0, 0.756122, 0.0148325, 0.120341, 0.0628378, 0.00236067},
    {1.0, 0.999, 10, 0, 0.839326, 0.138474, 0.133583, 0.188628, 0.0220316},
    {1.0, 0.999, 20, 0, 0.894167, 0.063029, 0.142311, 0.169671, 0.0100314},
    {1.4, 0.9, 10, 0, 0.30002, 0.0039389, 0.127754, 0.0255492, 0.00182769},
    {1.4, 0.99, 10, 0, 0.631001, 0.101143, 0.283073, 0.201192, 0.0474424},
    {1.4, 0.99, 20, 0, 0.639533, 0.0177621, 0.287077, 0.0913058, 0.00833518},
    {1.4, 0.999, 20, 0, 0.834036, 0.0930047, 0.378351, 0.283647, 0.043644},
    {1.0, 0.99, 50, 0.8, 0.509528, 0.0156918, 0.0810939, 0.0440239, 0.00249742},
    {1.4, 0.99, 50, 0.8, 0.383313, 0.0140326, 0.166841, 0.0553491, 0.00658505},
};
constexpr double printed_digits = 6e-6;  // relative: six digits
// That program lets the beam inside leave at the far face without being reflected there: 0.028 of
// e^-b, which is 1.3e-6 of the light where b = 10 and T = 0.004.
constexpr double reflected_beam_left_out = 3e-4;

TEST(SlabP1, AgainstAnotherProgram) {
  for (const Case& c : cases) {
    const double b = c.optical_thickness;
    const SlabP1 slab({b * (1.0 - c.albedo), b * c.albedo, c.g, c.ior, 0.0}, Boundary::marshak,
                      1.0);
    const double allowed = c.ior == 1.0 ? printed_digits : reflected_beam_left_out;
    EXPECT_NEAR(slab.reflected() / c.R, 1.0, allowed) << c.ior << " " << b;
    EXPECT_NEAR(slab.transmitted() / c.T, 1.0, allowed) << c.ior << " " << b;
    EXPECT_NEAR(slab.U_d(0.0) / c.U_front, 1.0, allowed);
    EXPECT_NEAR(slab.U_d(0.5) / c.U_middle, 1.0, allowed);
    EXPECT_NEAR(slab.U_d(1.0) / c.U_back, 1.0, allowed);
  }
}

// Energy: the three parts add up to one, whatever the anisotropy, the index, the extrapolation
// length; thin slabs, in which the beam is reflected often, and slabs without absorption included.
TEST(SlabP1, BalancesToRounding) {
  for (const Boundary boundary : {Boundary::marshak, Boundary::milne})
    for (const double g : {0.0, 0.5, 0.9})
      for (const double ior : {1.0, 1.4})
        for (const double sigma_a : {0.0, 1e-8, 1e-4, 0.01, 1.0})
          for (const double thickness : {0.05, 1.5, 200.0}) {
            const SlabP1 slab({sigma_a, 8.0, g, ior, 0.0}, boundary, thickness);
            EXPECT_NEAR(slab.reflected() + slab.transmitted() + slab.absorbed(), 1.0, 1e-9)
                << g << " " << ior << " " << sigma_a << " " << thickness;
          }
}

TEST(SlabP1, SatisfiesEquationAndBoundaryCondition) {
  for (const double sigma_a : {0.0, 0.4}) {
    const Medium medium{sigma_a, 3.0, 0.6, 1.4, 0.0};
    const DiffusionCoefficients c = diffusion_coefficients(medium, Boundary::milne);
    const SlabP1 slab(medium, Boundary::milne, 0.8);
    const double step = 1e-3;
    for (const double z : {0.1, 0.4, 0.7}) {
      const double second =
          (slab.U_d(z + step) - 2.0 * slab.U_d(z) + slab.U_d(z - step)) / (step * step);
      const double f = c.source_per_U_ri * slab.U_ri(z);
      EXPECT_NEAR(second - c.lambda * c.lambda * slab.U_d(z), f, 1e-4 * std::abs(f));
    }
    // The closed form may be evaluated a little outside: central differences at the faces.
    for (const double z : {0.0, 0.8}) {
      const double n = z == 0.0 ? -1.0 : 1.0;
      const double slope = n * (slab.U_d(z + step) - slab.U_d(z - step)) / (2.0 * step);
      EXPECT_NEAR(slab.U_d(z) + c.k * slope, c.robin_data(n * slab.Q_ri_z(z)),
                  1e-4 * std::abs(c.k * slope));
    }
  }
}

// Airy's sums for a plate that only absorbs: R = r (1 + T B), T = (1 - r)^2 B / (1 - r^2 B^2).
TEST(SlabP1, UnscatteredLightOfAPlate) {
  const SlabP1 plate({0.3, 1e-9, 0.0, 1.5, 0.0}, Boundary::marshak, 1.0);
  const double r = 0.04, B = std::exp(-0.3);
  const double T = (1 - r) * (1 - r) * B / (1 - r * r * B * B);
  EXPECT_NEAR(plate.unscattered_transmitted(), T, 1e-8);
  EXPECT_NEAR(plate.unscattered_reflected(), r + r * T * B, 1e-8);
}

// (1 - albedo)(1 - g albedo) = 1/3.
TEST(SlabP1, RefusesResonance) {
  EXPECT_THROW(SlabP1({1.0, 2.0, 0.0, 1.0, 0.0}, Boundary::marshak, 1.0), std::domain_error);
}

// The same model by another program, index-matched, four digits.
TEST(DiffuseSlabP1, KnownReflectanceAndTransmittance) {
  struct Known {
    double albedo, b, R, T;
  };
  for (const Known& known : {Known{0.99, 10, 0.7836, 0.0670}, Known{0.999, 20, 0.9139, 0.0503}}) {
    const DiffuseSlabP1 slab(
        {known.b * (1.0 - known.albedo), known.b * known.albedo, 0.0, 1.0, 0.0}, Boundary::marshak,
        1.0);
    EXPECT_NEAR(slab.reflected(), known.R, 5.1e-5);
    EXPECT_NEAR(slab.transmitted(), known.T, 5.1e-5);
  }
}

TEST(DiffuseSlabP1, BalancesToRounding) {
  for (const double ior : {1.0, 1.4})
    for (const double sigma_a : {0.0, 0.01, 1.0})
      for (const double thickness : {0.2, 3.0}) {
        const DiffuseSlabP1 slab({sigma_a, 8.0, 0.3, ior, 0.0}, Boundary::milne, thickness);
        EXPECT_NEAR(slab.reflected() + slab.transmitted() + slab.absorbed(), 1.0, 1e-11);
      }
}

}  // namespace
}  // namespace knotlight
