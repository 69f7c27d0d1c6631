#include "compare/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

ComparedModel model(SourceModel source, double error, double seconds) {
  ComparedModel m;
  m.run.model = source;
  m.run.solved.emplace();
  m.run.cost.light = seconds;
  m.errors.surface = error;
  m.errors.picture = 0.5 * error;
  return m;
}

Comparison comparison(double diffusion_error) {
  Comparison c;
  c.tolerance = 0.01;
  c.diffusion_itself.transport = diffusion_error;
  c.models.push_back(model(SourceModel::photon_map, 0.012, 5.0));
  c.models.push_back(model(SourceModel::irradiance_sampling, 0.06, 2.0));
  return c;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CompareVerdict, SaysWhatIsSavedAndWhatItCosts) {
  const std::vector<std::string> said = verdict(comparison(0.03));
  ASSERT_EQ(said.size(), 4U);
  EXPECT_TRUE(contains(said[0], "3 %")) << said[0];
  EXPECT_TRUE(contains(said[1], "photon_map comes within 1.2 %")) << said[1];
  EXPECT_TRUE(contains(said[2], "irradiance_sampling saves 3 s (60 %) and is 6 % off")) << said[2];
  EXPECT_TRUE(contains(said[3], "take photon_map")) << said[3];
  EXPECT_FALSE(contains(said[3], "good enough")) << said[3];
}

TEST(CompareVerdict, WhatDiffusionMissesMayMakeACheapModelGoodEnough) {
  const std::string choice = verdict(comparison(0.1)).back();
  EXPECT_TRUE(contains(choice, "take photon_map")) << choice;
  EXPECT_TRUE(contains(choice, "irradiance_sampling is good enough")) << choice;
}

TEST(CompareVerdict, TheQuickestWithinToleranceIsTaken) {
  Comparison c = comparison(0.001);
  c.models[1].errors.surface = 0.011;
  EXPECT_TRUE(contains(verdict(c).back(), "take irradiance_sampling"));
  for (ComparedModel& m : c.models) m.errors.surface = 0.5;
  EXPECT_TRUE(contains(verdict(c).back(), "None stays within"));
}

TEST(CompareVerdict, ModelsThatFailedAreNamedWithTheReason) {
  Comparison c = comparison(0.03);
  c.no_truth = "the scene has no lights";
  c.models[1].run.solved.reset();
  c.models[1].run.cannot = "because";
  c.models.push_back(model(SourceModel::boundary_flux, NAN, 1.0));
  const std::vector<std::string> said = verdict(c);
  EXPECT_TRUE(contains(said[1], "irradiance_sampling cannot be run here: because"));
  EXPECT_TRUE(contains(said[2], "boundary_flux came to no solution"));
}

TEST(CompareVerdict, Percent) {
  EXPECT_EQ(percent(0.0123), "1.2 %");
  EXPECT_EQ(percent(2.65), "265 %");
  EXPECT_EQ(percent(NAN), "unknown");
}

}  // namespace
}  // namespace knotlight
