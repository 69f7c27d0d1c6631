#include "rivals/dipole.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "core/fresnel.h"
#include "rival_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::beam;
using test::half_space;
using test::one_object;

DipoleSolution solve(const PreparedScene& p, const DipoleSettings& settings = {},
                     std::uint64_t seed = 1, int threads = 2) {
  return {p.scene, *p.caster, 0, 0, settings, seed, Workers(threads)};
}

// n x n places about the origin on the top of a half-space.
Points window(int n, double spacing) {
  Points points(3, n * n);
  for (int i = 0; i < n * n; ++i)
    points.col(i) = spacing * Vec3(i % n - 0.5 * (n - 1), i / n - 0.5 * (n - 1), 0.0);
  return points;
}

// Under a beam each place of a half-space gives back the closed form of [JMLH01]. The samples are
// a sum over some hundred evenly spread places, so its error is close to normal; nine of them 5
// mean free paths apart are independent, and five standard errors of their mean (0.1 / 20 / 3 each)
// are 0.8 %: a false alarm once in a million. 0.15 % is cut off at the box's edges.
TEST(Dipole, HalfSpaceUnderABeam) {
  for (const double ior : {1.0, 1.4}) {
    const Medium m{0.1, 0.9, 0.0, ior, 0.0};
    const PreparedScene p = half_space(m, beam(Vec3(0.6, 0.0, -0.8), 3.0));
    const DipoleSolution solution = solve(p);
    const Points points = window(3, 5.0);
    const Eigen::VectorXd M = solution.exitances(points, Workers(1));
    const double entered = 3.0 * 0.8 * (1.0 - fresnel_reflectance(0.8, ior));
    const double expected = entered * dipole_kernel(m, DipoleForm::classic).total();
    EXPECT_NEAR(M.mean() / expected, 1.0, 8e-3 + 1.5e-3) << ior;
    EXPECT_NEAR(solution.spacing(), 1.0 / std::sqrt(DipoleSettings().samples_per_square), 1e-3);
    const double A = diffuse_internal_reflection(ior).A;
    EXPECT_NEAR(solution.mean_intensities(points, Workers(1))[3], A * M[3] / (2.0 * pi), 1e-14);
  }
}

// 0.1 over the number of samples per square: measured over many seeds, 0.06 to 0.11. The rms of 25
// places errs by 15 % and some more, since they are not quite independent; a factor of two either
// way is five of that.
TEST(Dipole, NoiseFallsAsOneOverTheNumberOfSamples) {
  const Medium m{0.1, 0.9, 0.0, 1.0, 0.0};
  const PreparedScene p = half_space(m, beam(-Vec3::UnitZ(), 1.0));
  const double expected = dipole_kernel(m, DipoleForm::classic).total();
  for (const double density : {2.0, 8.0}) {
    DipoleSettings settings;
    settings.samples_per_square = density;
    const Eigen::VectorXd M = solve(p, settings).exitances(window(5, 4.0), Workers(2));
    const double noise = std::sqrt((M.array() / expected - 1.0).square().mean());
    EXPECT_LT(noise, 0.2 / density) << density;
    EXPECT_GT(noise, 0.05 / density) << density;
  }
}

TEST(Dipole, SameBitsForAnyNumberOfThreads) {
  const PreparedScene p = one_object(Sphere{Vec3::Zero(), 1.0}, {0.1, 10.0, 0.0, 1.3, 0.0},
                                     EnvironmentLight{Spectrum::Constant(1.0), nullptr});
  Points points(3, 2);
  points << 1, 0, 0, 0.6, 0, 0.8;
  const DipoleSolution one = solve(p, {}, 7, 1);
  const DipoleSolution three = solve(p, {}, 7, 3);
  EXPECT_EQ(one.exitances(points, Workers(1)), three.exitances(points, Workers(3)));
  EXPECT_NE(one.exitances(points, Workers(1)), solve(p, {}, 8).exitances(points, Workers(1)));
}

// The caps hold, and tell.
TEST(Dipole, TooFewSamplesShow) {
  const PreparedScene p =
      one_object(Sphere{Vec3::Zero(), 1.0}, {10.0, 990.0, 0.0, 1.0, 0.0}, beam(Vec3::UnitX(), 1.0));
  DipoleSettings settings;
  settings.most_samples = 10'000;
  const DipoleSolution solution = solve(p, settings);
  EXPECT_LT(solution.tree().size(), 5'100U);  // the lit half
  EXPECT_NEAR(solution.spacing(), std::sqrt(4.0 * pi * 1e6 / 1e4), 1e-9);
}

TEST(Dipole, RefusesEmission) {
  const PreparedScene p =
      one_object(Sphere{Vec3::Zero(), 1.0}, {0.1, 10.0, 0.0, 1.0, 2.0}, beam(Vec3::UnitX(), 1.0));
  try {
    solve(p);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("object 'body': emits light"), std::string::npos);
  }
}

}  // namespace
}  // namespace knotlight
