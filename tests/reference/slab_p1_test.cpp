#include "reference/slab_p1.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

struct Case {
  double albedo, optical_thickness, g, R, T;
};

// P1 values of the slab table in docs/theory.md, section 8, to all the digits known.
TEST(SlabP1, KnownReflectanceAndTransmittance) {
  for (const Case& c :
       {Case{0.9, 2, 0, 0.370523, 0.367873}, Case{0.99, 10, 0, 0.744501, 0.0854638},
        Case{0.999, 20, 0, 0.894167, 0.063029}, Case{0.99, 50, 0.8, 0.509528, 0.0156918}}) {
    const double b = c.optical_thickness;
    const SlabP1 slab({b * (1.0 - c.albedo), b * c.albedo, c.g, 1.0, 0.0}, Boundary::marshak, 1.0);
    EXPECT_NEAR(slab.reflected(), c.R, 1e-6);
    EXPECT_NEAR(slab.transmitted(), c.T, 1e-6);
  }
}

TEST(SlabP1, KnownMeanIntensity) {
  const SlabP1 slab({0.1, 9.9, 0.0, 1.0, 0.0}, Boundary::marshak, 1.0);
  EXPECT_NEAR(slab.U_d(0.0), 0.118491, 1e-6);
  EXPECT_NEAR(slab.U_d(0.5), 0.132648, 1e-6);
  EXPECT_NEAR(slab.U_d(1.0), 0.0135948, 1e-7);
}

// Energy: the three parts add up to one, whatever the anisotropy and the extrapolation length.
TEST(SlabP1, BalancesToRounding) {
  for (const Boundary boundary : {Boundary::marshak, Boundary::milne})
    for (const double g : {0.0, 0.5, 0.9})
      for (const double sigma_a : {1e-4, 0.01, 1.0}) {
        const SlabP1 slab({sigma_a, 8.0, g, 1.0, 0.0}, boundary, 1.5);
        EXPECT_NEAR(slab.reflected() + slab.transmitted() + slab.absorbed(), 1.0, 1e-11);
      }
}

}  // namespace
}  // namespace knotlight
