#include "pipeline/photon_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/glow.h"
#include "pipeline/sample_points.h"
#include "pipeline/solve_scene.h"
#include "scene/scene_reader.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

RunContext quiet_run() {
  RunOptions options;
  options.quiet = true;
  return {options, false};
}

constexpr const char* ball = R"(
units: mm
camera: {type: orthographic, from: [0, 0, 5], to: [0, 0, 0], up: [0, 1, 0], width: 2.4, resolution: [8, 8]}
lights: [{type: point, position: [3, 0, 3], intensity: 18}]
materials: {wax: {type: translucent, sigma_a: 0.1, sigma_s: 10}}
objects: [{name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}]
)";

SolvedScene solved(const std::vector<std::string>& overrides, bool picture = false) {
  const test::ScratchFolder scratch;
  Scene scene = read_scene(scratch.write("ball.yaml", ball), overrides);
  if (picture) choose_for_picture(scene.solver);
  RunContext run = quiet_run();
  return solve_scene(prepare_scene(std::move(scene)), run);
}

TEST(PhotonBudget, NoMoreThanTheNoiseCallsFor) {
  for (const char* tolerance : {"solver.tolerance=0.02", "solver.tolerance=0.08"}) {
    const SolvedScene one = solved({tolerance});
    // The most is 2e6 (0.01 / tolerance); this even a ball does not need.
    const double aim = tolerance == std::string("solver.tolerance=0.02") ? 0.02 : 0.08;
    EXPECT_LT(one.report.photons_emitted, 0.5 * 2e6 * 0.01 / aim);
    EXPECT_GE(one.report.photons_emitted, 20'000U);
    EXPECT_LT(one.objects[0][0].report.noise, 0.6 * aim);
  }
}

// A body a hundred mean free paths wide: the first try is not enough.
TEST(PhotonBudget, MoreWhereThereIsMoreNoise) {
  const SolvedScene one = solved({"solver.tolerance=0.04", "materials.wax.sigma_s=50"});
  EXPECT_GT(one.report.photons_emitted, solved({"solver.tolerance=0.04"}).report.photons_emitted);
  EXPECT_LT(one.objects[0][0].report.noise, 0.6 * 0.04);
}

TEST(PhotonBudget, GuessesFromTheNoise) {
  const auto needed = [](double noise, double numerical_error) {
    Report report;
    report.objects = {ObjectReport{}};
    report.objects[0].channels.resize(2);
    for (ChannelReport& channel : report.objects[0].channels) channel.photons = 500;
    report.objects[0].channels[0].noise = noise;
    report.objects[0].channels[0].numerical_error = numerical_error;
    report.objects[0].channels[1].noise = 0.001;
    return photons_needed(report, 1'000, 16'000, 0.01);
  };
  EXPECT_EQ(needed(0.006, 0.0), 1'000U);
  // Twice what is aimed at, n^-0.65.
  EXPECT_NEAR(static_cast<double>(needed(0.0084, 0.0)), 2'905.0, 1.0);
  for (const double much : {1.0, std::nan(""), HUGE_VAL}) EXPECT_EQ(needed(much, 0.0), 16'000U);
  // Beside a large error of the cells more is accepted, as long as the sum is trusted.
  EXPECT_EQ(needed(0.007, 0.0175), 1'000U);
  EXPECT_GE(needed(0.007, 0.024), 1'500U);
  EXPECT_EQ(first_photons(16'000'000), 1'000'000U);
  EXPECT_EQ(first_photons(100'000), 20'000U);
  EXPECT_EQ(first_photons(10'000), 10'000U);
}

// Nothing seen is not nothing there: a ball that few photons find through a pinhole.
TEST(PhotonBudget, AllOfThemBeforeAnObjectCountsAsDark) {
  Report report;
  report.objects = {ObjectReport{}};
  report.objects[0].channels.resize(1);
  EXPECT_EQ(photons_needed(report, 1'000, 16'000, 0.01), 16'000U);
}

// What a report calls noise is what differs from seed to seed, over the whole surface: here over
// eight seeds at 500 points, so known to some 10 %; the halves of one run know it to some 30 %.
TEST(PhotonBudget, ReportedNoiseIsTheSpreadOverSeeds) {
  const test::ScratchFolder scratch;
  const PreparedScene prepared = prepare_scene(read_scene(
      scratch.write("ball.yaml", ball), {"solver.tolerance=0.04", "solver.photons=40000"}));
  const Points points = columns(stratified_surface_points(prepared.scene.objects[0].shape, 500,
                                                          true, 1, Stream::check_points))
                            .positions;
  constexpr int seeds = 8;
  Eigen::MatrixXd values(points.cols(), seeds);
  double reported = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    RunOptions options;
    options.quiet = true;
    options.seed = static_cast<std::uint64_t>(seed + 1);
    RunContext run(options, false);
    const SolvedScene one = solve_scene(prepared, run);
    values.col(seed) = one.objects[0][0].U_d(points);
    reported += one.objects[0][0].report.noise / seeds;
  }
  const Eigen::VectorXd mean = values.rowwise().mean();
  const double spread =
      std::sqrt((values.colwise() - mean).squaredNorm() / (seeds - 1)) / mean.norm();
  EXPECT_NEAR(reported / spread, 1.0, 0.35);
}

TEST(PhotonBudget, WhatTheSceneSaysIsDone) {
  EXPECT_EQ(solved({"solver.photons=300000", "solver.tolerance=0.08"}).report.photons_emitted,
            300'000U);
}

// A gathered picture of a refracting object looks at the photons themselves.
TEST(PhotonBudget, AllOfThemWhereTheyAreLookedAt) {
  const std::vector<std::string> glass = {"solver.tolerance=0.08", "materials.wax.ior=1.4"};
  EXPECT_EQ(solved(glass, true).report.photons_emitted, 250'000U);
  EXPECT_LT(solved(glass).report.photons_emitted, 250'000U);
}

}  // namespace
}  // namespace knotlight
