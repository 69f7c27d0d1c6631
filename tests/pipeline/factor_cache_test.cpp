// What is expensive about a method is done once: for channels that share lambda and k, and for new
// lights.
#include "pipeline/factor_cache.h"

#include <gtest/gtest.h>

#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"

namespace knotlight {
namespace {

// A unit ball under one beam; in the third of three channels it absorbs more.
Scene ball(Method method, int channels, const Vec3& direction) {
  TranslucentMaterial wax;
  wax.sigma_a = Spectrum(0.5, 0.5, 1.0);
  wax.sigma_s = Spectrum::Constant(9.5);
  Scene s;
  s.units = "cm";
  s.channels = channels;
  s.lights = {DirectionalLight{direction, Spectrum::Ones()}};
  s.objects = {{"ball", Sphere{Vec3::Zero(), 1.0}, wax}};
  s.solver.method = method;
  s.solver.tolerance = 0.05;
  s.solver.photons = 20'000;
  return s;
}

Eigen::VectorXd field(const SolvedScene& solved, std::size_t channel) {
  Points x(3, 3);
  x << 0.0, 0.5, 0.0, 0.0, 0.0, -1.0, 1.0, 0.5, 0.0;
  return solved.objects[0][channel].U_d(x);
}

class EveryMethod : public testing::TestWithParam<Method> {};

TEST_P(EveryMethod, ChannelsOfOneLambdaShareAFactorisation) {
  RunContext run(RunOptions{}, false);
  const PreparedScene prepared = prepare_scene(ball(GetParam(), 3, -Vec3::UnitZ()));
  FactorCache factors;
  const SolvedScene solved = solve_scene(prepared, run, factors);
  // Two lambdas; the grid's cells, shared by all, are one more.
  EXPECT_EQ(factors.size(), GetParam() == Method::grid ? 3U : 2U);
  EXPECT_TRUE(solved.report.failures.empty()) << solved.report.failures.front();
  EXPECT_NE(field(solved, 0), field(solved, 2));
}

// Whatever an earlier channel has left in the cache, equal channels are equal: in all bits, but for
// lbkm, which sums up photons at the knots of one round after the other the first time, and at all
// the second.
TEST_P(EveryMethod, EqualChannelsAreEqual) {
  RunContext run(RunOptions{}, false);
  Scene scene = ball(GetParam(), 3, -Vec3::UnitZ());
  scene.solver.tolerance = 0.005;  // so that a first attempt will not do
  const PreparedScene prepared = prepare_scene(std::move(scene));
  const SolvedScene solved = solve_scene(prepared, run);
  const double allowed = GetParam() == Method::lbkm ? 1e-4 : 0.0;
  EXPECT_LE((field(solved, 0) - field(solved, 1)).norm(), allowed * field(solved, 0).norm());
}

TEST_P(EveryMethod, ANewLightOnKeptFactorsGivesWhatItGivesAlone) {
  RunContext run(RunOptions{}, false);
  FactorCache factors;
  const PreparedScene before = prepare_scene(ball(GetParam(), 1, -Vec3::UnitZ()));
  const SolvedScene first = solve_scene(before, run, factors);
  const std::size_t entries = factors.size();
  const PreparedScene turned = prepare_scene(ball(GetParam(), 1, Vec3::UnitY()));
  const SolvedScene kept = solve_scene(turned, run, factors);
  EXPECT_EQ(factors.size(), entries);
  const SolvedScene alone = solve_scene(turned, run);
  EXPECT_EQ(field(kept, 0), field(alone, 0));
  EXPECT_NE(field(kept, 0), field(first, 0));
}

INSTANTIATE_TEST_SUITE_P(FactorCache, EveryMethod,
                         testing::Values(Method::grid, Method::bkm, Method::mfs, Method::lbkm),
                         [](const auto& method) { return std::string(name_of(method.param)); });

}  // namespace
}  // namespace knotlight
