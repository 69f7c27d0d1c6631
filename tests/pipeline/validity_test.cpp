#include "pipeline/validity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

// Sphere: largest extent 2 R, mean chord 4 V / S = 4 R / 3.
TEST(Validity, SphereInItsUnits) {
  const Medium medium{0.2, 19.8, 0.5, 1.0, 0.0};
  const Validity v = diffusion_validity(Sphere{Vec3(1, 2, 3), 2.0}, medium);
  EXPECT_NEAR(v.size, 4.0, 1e-12);
  EXPECT_NEAR(v.size_in_mean_free_paths, 80.0, 1e-10);
  EXPECT_NEAR(v.thickness, 8.0 / 3.0 * (0.2 + 0.5 * 19.8), 1e-10);
  EXPECT_NEAR(v.lambda_R, 2.0 * std::sqrt(3.0 * 0.2 * 10.1), 1e-12);
  EXPECT_NEAR(v.reduced_albedo, 9.9 / 10.1, 1e-14);
  EXPECT_TRUE(v.valid);
  EXPECT_TRUE(v.reasons.empty());
}

TEST(Validity, ThinOrDarkObjectsAreRefusedWithAReason) {
  const Shape plate = box_mesh(Vec3(-5, -5, 0), Vec3(5, 5, 0.05));
  const Validity thin = diffusion_validity(plate, {0.1, 10.0, 0.0, 1.0, 0.0});
  EXPECT_FALSE(thin.valid);
  ASSERT_EQ(thin.reasons.size(), 1U);
  EXPECT_NE(thin.reasons[0].find("thickness"), std::string::npos);
  const Validity dark = diffusion_validity(Sphere{}, {10.0, 10.0, 0.0, 1.0, 0.0});
  EXPECT_FALSE(dark.valid);
  EXPECT_NE(dark.reasons[0].find("albedo"), std::string::npos);
}

}  // namespace
}  // namespace knotlight
