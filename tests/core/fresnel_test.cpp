#include "core/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

// Normal incidence: ((n - 1)/(n + 1))^2.
TEST(Fresnel, NormalIncidence) {
  EXPECT_NEAR(fresnel_reflectance(1.0, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_reflectance(1.0, 1.0 / 1.5), 0.04, 1e-15);
}

// At Brewster's angle tan(theta) = n the parallel part vanishes: R = R_s / 2 with
// R_s = ((n^2 - 1)/(n^2 + 1))^2.
TEST(Fresnel, BrewsterAngle) {
  constexpr double n = 1.4;
  const double cos_i = 1.0 / std::sqrt(1.0 + n * n);
  const double r_s = (n * n - 1.0) / (n * n + 1.0);
  EXPECT_NEAR(fresnel_reflectance(cos_i, n), 0.5 * r_s * r_s, 1e-14);
}

TEST(Fresnel, TotalInternalReflectionAndGrazing) {
  EXPECT_EQ(fresnel_reflectance(0.3, 1.0 / 1.4), 1.0);  // critical cosine 0.69985
  EXPECT_EQ(fresnel_reflectance(0.0, 1.4), 1.0);
  EXPECT_LT(fresnel_reflectance(0.7, 1.0 / 1.4), 1.0);
}

TEST(Fresnel, IndexMatchedSurfaceDoesNothing) {
  for (const double cosine : {1.0, 0.5, 1e-8, 0.0})
    EXPECT_EQ(fresnel_reflectance(cosine, 1.0), 0.0);
}

// The reflectance is the same from both sides along one refracted path.
TEST(Fresnel, Reciprocity) {
  for (const double cos_o : {0.05, 0.3, 0.9}) {
    const double cos_i = std::sqrt(1.0 - (1.0 - cos_o * cos_o) / (1.4 * 1.4));
    EXPECT_NEAR(fresnel_reflectance(cos_o, 1.4), fresnel_reflectance(cos_i, 1.0 / 1.4), 1e-13);
  }
}

TEST(Fresnel, RefractionObeysSnellAndStaysInThePlane) {
  const Vec3 n = Vec3(0.2, -0.4, 1.0).normalized();
  const Vec3 d = Vec3(0.5, 0.3, -0.9).normalized();
  for (const Vec3& side : {n, Vec3(-n)}) {
    const auto t = refract(d, side, 1.4);
    ASSERT_TRUE(t);
    EXPECT_NEAR(t->norm(), 1.0, 1e-15);
    EXPECT_NEAR(d.cross(n).norm(), 1.4 * t->cross(n).norm(), 1e-14);
    EXPECT_NEAR(t->dot(d.cross(n)), 0.0, 1e-14);
    EXPECT_GT(t->dot(d), 0.0);
    const auto back = refract(-*t, side, 1.0 / 1.4);
    ASSERT_TRUE(back);
    EXPECT_NEAR((*back + d).norm(), 0.0, 1e-13);
  }
}

TEST(Fresnel, ReflectionTurnsTheNormalPart) {
  const Vec3 r = reflect(Vec3(1.0, 0.0, -1.0).normalized(), Vec3::UnitZ());
  EXPECT_NEAR((r - Vec3(1.0, 0.0, 1.0).normalized()).norm(), 0.0, 1e-15);
}

// A = 1 without an index step; A = 2.9485 at 1.4 (Haskell's moments); R grows with the index.
TEST(DiffuseReflection, KnownValues) {
  EXPECT_EQ(diffuse_internal_reflection(1.0).A, 1.0);
  EXPECT_NEAR(diffuse_internal_reflection(1.4).A, 2.9485, 5e-5);
  EXPECT_LT(diffuse_internal_reflection(1.2).R, diffuse_internal_reflection(1.3).R);
  EXPECT_NEAR(diffuse_internal_reflection(1.0 + 1e-9).A, 1.0, 1e-3);
}

// The moments again, by a midpoint rule fine enough to resolve the kink at the critical angle.
TEST(DiffuseReflection, MatchesBruteForceQuadrature) {
  for (const double ior : {1.1, 1.33, 1.5}) {
    constexpr int cells = 2'000'000;
    double R_phi = 0.0;
    double R_j = 0.0;
    for (int i = 0; i < cells; ++i) {
      const double mu = (i + 0.5) / cells;
      const double R = fresnel_reflectance(mu, 1.0 / ior);
      R_phi += 2.0 * mu * R / cells;
      R_j += 3.0 * mu * mu * R / cells;
    }
    const double R = (R_phi + R_j) / (2.0 - R_phi + R_j);
    EXPECT_NEAR(diffuse_internal_reflection(ior).R, R, 1e-7) << ior;
    EXPECT_NEAR(transmitted_flux_moment(ior, 0.0), 1.0 - R_phi, 1e-7) << ior;
    EXPECT_NEAR(transmitted_flux_moment(ior, 1.5) - transmitted_flux_moment(ior, 0.0),
                1.5 * (2.0 / 3.0) * (1.0 - R_j), 1e-7)
        << ior;
  }
}

}  // namespace
}  // namespace knotlight
