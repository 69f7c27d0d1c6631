#include "stability/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/errors.h"
#include "stability/report.h"
#include "stability/studies.h"
#include "support/program.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

ExtremeTrial good() {
  ExtremeTrial t;
  t.scene = "scene, with a comma";
  t.method = "grid";
  t.finite = true;
  t.error = t.error_estimate = 0.01;
  t.allowed = 0.06;
  t.seconds = 1.0;
  return t;
}

TEST(ExtremeTrial, WhatBreaksTheRule) {
  EXPECT_FALSE(good().breaks_the_rule());
  ExtremeTrial t = good();
  t.error = 0.07;
  EXPECT_TRUE(t.wrong());
  t.error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(t.wrong());
  t.exit_code = exit_untrusted;  // it says so
  EXPECT_FALSE(t.breaks_the_rule());
  t.exit_code = exit_bad_input;
  EXPECT_FALSE(t.breaks_the_rule());
  t.exit_code = exit_failure;
  EXPECT_TRUE(t.crashed() && t.breaks_the_rule());
  t = good();
  t.finite = false;
  EXPECT_TRUE(t.wrong());
  t = good();
  t.seconds = 2.0 * longest_seconds;
  EXPECT_TRUE(t.too_slow() && t.breaks_the_rule());
}

// A scene that the program refuses is a refusal, no crash: two bodies in the same place.
TEST(Extremes, RefusalsAreNotCrashes) {
  ExtremeScene scene = extreme_scenes(true)[0];
  const SurfaceTruth truth = truth_of(scene, 1);
  scene.scene.objects.push_back(scene.scene.objects[0]);
  const ExtremeTrial t = try_extreme(scene, Method::grid, truth, 1);
  EXPECT_EQ(t.exit_code, exit_bad_input);
  EXPECT_FALSE(t.breaks_the_rule());
}

// The references of all scenes but those that a grid must be solved for. The series of the balls is
// right to 1e-3 of its largest value, and negative by less where it is dark.
TEST(Extremes, ClosedFormsAreFinite) {
  for (const ExtremeScene& scene : extreme_scenes(false)) {
    if (scene.truth == ExtremeScene::Truth::fine_grid) continue;
    const SurfaceTruth truth = truth_of(scene, 1);
    EXPECT_TRUE(truth.U_d.allFinite()) << scene.name;
    EXPECT_GT(truth.U_d.minCoeff(), -1e-3 * truth.U_d.maxCoeff()) << scene.name;
    EXPECT_GT(truth.positions.cols(), 100) << scene.name;
  }
}

// The quick selection keeps the rule, and its maps have the same bits on three threads and on one.
TEST(StabilityCommand, WritesItsFolderAndKeepsTheRule) {
  const test::ScratchFolder scratch;
  const auto run = test::run_program(
      KNOTLIGHT_PROGRAM, "stability --quick --threads 3 -o new/folder", scratch.folder());
  EXPECT_EQ(run.exit_code, exit_ok) << run.err << run.out;
  EXPECT_NE(run.out.find("none crashed, hung, or were wrong"), std::string::npos) << run.out;
  const std::string folder = scratch.path("new/folder");
  for (const char* file : {"stability-scenes.csv", "stability-error-sphere-far.svg",
                           "stability-distance-torus.svg", "stability-scenes.svg"})
    EXPECT_FALSE(test::read_file(folder + "/" + file).empty()) << file;
  const std::string page = test::read_file(folder + "/stability.html");
  EXPECT_NE(page.find("tiny ball"), std::string::npos);

  Stability again;
  for (const StudyJob& job : study_jobs(true, 1))
    for (const Trial& trial : job()) again.trials.push_back(trial);
  EXPECT_TRUE(trials_csv(again) == test::read_file(folder + "/stability.csv"));
  EXPECT_GE(again.trials.size(), 500U);
}

TEST(StabilityCommand, NeedsAFolder) {
  const test::ScratchFolder scratch;
  const auto run = test::run_program(KNOTLIGHT_PROGRAM, "stability --quick", scratch.folder());
  EXPECT_EQ(run.exit_code, exit_bad_input);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST(StabilityReport, SaysWhatIsBroken) {
  Stability s;
  s.extremes = {good(), good()};
  EXPECT_NE(stability_verdict(s).find("2 of 2"), std::string::npos);
  EXPECT_NE(stability_verdict(s).find("none"), std::string::npos);
  s.extremes[1].error = 1.0;
  EXPECT_EQ(s.broken(), 1U);
  EXPECT_NE(stability_text(s).find("WRONG"), std::string::npos);
  const std::string csv = scenes_csv(s);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_NE(csv.find("\"scene, with a comma\",grid,0,1,0.01,0.06,yes,1,WRONG,"), std::string::npos)
      << csv;
}

}  // namespace
}  // namespace knotlight
