// The boundary methods end to end: errors against exact solutions are below what they say, or they
// say that they cannot be trusted.
#include "pipeline/solve_boundary.h"

#include <gtest/gtest.h>

#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "reference/sphere_beam_p1.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

Scene body(Shape shape, const Medium& medium, Method method) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(medium.sigma_a);
  material.sigma_s = Spectrum::Constant(medium.sigma_s);
  material.g = Spectrum::Constant(medium.g);
  Scene scene;
  scene.objects = {{"body", std::move(shape), material}};
  scene.lights = {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}};
  scene.solver.method = method;
  scene.solver.boundary = Boundary::marshak;
  scene.solver.photons = 100'000;
  scene.solver.tolerance = 0.02;
  return scene;
}

// Relative L2 error of U_d at 200 points of the unit sphere.
double error_on_ball(const SolvedScene& solved, const Medium& medium) {
  const SphereBeamP1 exact(medium, Boundary::marshak, 1.0);
  Points x(3, 200);
  for (int i = 0; i < 200; ++i) {
    const double z = (2.0 * i + 1.0) / 200.0 - 1.0;
    const double s = std::sqrt(1.0 - z * z), phi = 2.399963229728653 * i;
    x.col(i) = Vec3(s * std::cos(phi), s * std::sin(phi), z);
  }
  const Eigen::VectorXd u = solved.objects[0][0].U_d(x);
  double error = 0.0, size = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double truth = exact.U_d(x.col(i));
    error += (u[i] - truth) * (u[i] - truth);
    size += truth * truth;
  }
  return std::sqrt(error / size);
}

class BoundaryMethods : public testing::TestWithParam<Method> {};

// Under a beam, with sources in the volume alone (g = 0) and on the surface too (g != 0). What is
// seen at 200 points may differ from the rms that is estimated by more than it says once in a
// while: 1.3 times are allowed, measured 0.4 to 0.9.
TEST_P(BoundaryMethods, KnowHowFarOffTheyAreOnABall) {
  for (const double g : {-0.5, 0.0, 0.3}) {
    const Medium medium{0.5, 10.0 / (1.0 - g), g, 1.0, 0.0};
    RunContext run(RunOptions{}, false);
    const PreparedScene prepared =
        prepare_scene(body(Sphere{Vec3::Zero(), 1.0}, medium, GetParam()));
    const SolvedScene solved = solve_scene(prepared, run);
    const double estimate = solved.objects[0][0].report.error_estimate;
    EXPECT_LT(error_on_ball(solved, medium), 1.3 * estimate) << g;
    EXPECT_LT(estimate, 0.1) << g;
  }
}

// A torus whose hole is a hundredth of its size wide: images must not lie in the opposite wall.
// What comes out balances its energy, or is not trusted.
TEST_P(BoundaryMethods, StayHonestAcrossANarrowHole) {
  const Medium medium{0.2, 9.8, 0.0, 1.0, 0.0};
  RunContext run(RunOptions{}, false);
  Scene scene = body(test::torus_mesh(1.0, 0.99, 64, 64), medium, GetParam());
  scene.lights.push_back(PointLight{Vec3(0.0, 0.0, 0.2), Spectrum::Constant(0.1)});
  const PreparedScene prepared = prepare_scene(std::move(scene));
  const SolvedScene solved = solve_scene(prepared, run);
  const ChannelReport& report = solved.objects[0][0].report;
  if (solved.report.failures.empty()) {
    EXPECT_LT(std::abs(report.energy_imbalance),
              0.02 + 3.0 * report.energy_imbalance_standard_error);
  }
  EXPECT_TRUE(std::isfinite(report.error_estimate));
}

// Where a grid of affordable cells is too coarse, auto tries the boundary methods first, and says
// what it took.
TEST(SolveBoundary, AutoTriesThemOnDenseObjects) {
  const Medium medium{1.0, 99.0, 0.0, 1.0, 0.0};
  RunContext run(RunOptions{}, false);
  const PreparedScene prepared =
      prepare_scene(body(Sphere{Vec3::Zero(), 1.0}, medium, Method::automatic));
  const SolvedScene solved = solve_scene(prepared, run);
  EXPECT_EQ(solved.plan.methods.at(0).method, Method::automatic);
  const ChannelReport& report = solved.objects[0][0].report;
  EXPECT_FALSE(report.method.empty());
  EXPECT_LT(error_on_ball(solved, medium), 1.3 * report.error_estimate);
}

INSTANTIATE_TEST_SUITE_P(SolveBoundary, BoundaryMethods,
                         testing::Values(Method::bkm, Method::mfs, Method::lbkm),
                         [](const auto& method) { return std::string(name_of(method.param)); });

}  // namespace
}  // namespace knotlight
