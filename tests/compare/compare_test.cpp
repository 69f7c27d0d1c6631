// The whole command on a small scene.
#include "compare/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/errors.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

constexpr const char* ball = R"(units: mm
camera: {type: perspective, from: [0, -4, 1], to: [0, 0, 0], fov: 35, resolution: [48, 36], samples: 1}
lights:
  - {type: directional, direction: [0, 0.6, -0.8], irradiance: 1}
materials:
  wax: {type: translucent, sigma_a: 0.05, sigma_s: 4}
objects:
  - {name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}
solver: {tolerance: 0.05}
)";

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Compare, WritesAPageThatStandsAlone) {
  const test::ScratchFolder scratch;
  RunOptions run_options;
  run_options.quiet = true;
  RunContext run(run_options, false);
  Scene scene;
  const CompareOptions options{20'000, 1e6, true};
  const Report report =
      compare_scene(scratch.write("ball.yaml", ball), scratch.path("out"), options, run, scene);
  ASSERT_EQ(report.objects.size(), 1U);
  EXPECT_TRUE(report.failures.empty()) << report.failures.front();

  const std::string page = contents(scratch.path("out/index.html"));
  for (const char* part :
       {"<!DOCTYPE html>", "photon_map comes within", "irradiance_sampling", "irradiance_thesis",
        "boundary_flux", "data:image/png;base64,", "<svg", "</html>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  // Nothing is fetched: names of XML's vocabularies are the only addresses.
  for (const char* fetch : {"<link", "<script", "src=\"http", "url(http"})
    EXPECT_EQ(page.find(fetch), std::string::npos) << fetch;

  EXPECT_EQ(lines(contents(scratch.path("out/compare.csv"))), 6U);   // header, models, converged
  EXPECT_EQ(lines(contents(scratch.path("out/budgets.csv"))), 17U);  // header, 4 models x 4
  EXPECT_GT(lines(contents(scratch.path("out/lines.csv"))), 10U);
}

// Same seed, other number of threads: the figures keep their bits; only seconds and memory differ.
// And they make sense: the photon map is near the converged solution and the photons, models that
// know less of the light are further off.
TEST(Compare, FiguresDoNotDependOnThreadsAndMakeSense) {
  const test::ScratchFolder scratch;
  const std::string path = scratch.write("ball.yaml", ball);
  const CompareOptions options{20'000, 1e6, false};
  Scene scene;
  std::vector<Comparison> runs;
  for (const int threads : {1, 2}) {
    RunOptions run_options;
    run_options.quiet = true;
    run_options.threads = threads;
    RunContext run(run_options, false);
    runs.push_back(compare_models(path, options, run, scene));
  }
  ASSERT_EQ(runs[0].models.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(runs[0].models[i].errors.surface, runs[1].models[i].errors.surface) << i;
    EXPECT_EQ(runs[0].models[i].errors.transport, runs[1].models[i].errors.transport) << i;
  }
  const Comparison& c = runs[0];
  EXPECT_LT(c.models[0].errors.surface, 0.1);
  EXPECT_LT(c.diffusion_itself.transport, 0.15);
  EXPECT_GT(c.models[1].errors.surface, c.models[0].errors.surface);
  EXPECT_GT(c.models[3].errors.surface, c.models[0].errors.surface);
}

TEST(Compare, AModelThatCannotRunIsShownWithItsReason) {
  const test::ScratchFolder scratch;
  RunOptions run_options;
  run_options.quiet = true;
  run_options.overrides = {"solver.method=grid"};
  RunContext run(run_options, false);
  Scene scene;
  const Comparison c =
      compare_models(scratch.write("ball.yaml", ball), {20'000, 1e6, false}, run, scene);
  EXPECT_FALSE(c.models[2].run.ran());
  EXPECT_NE(c.models[2].run.cannot.find("irradiance_thesis"), std::string::npos);
  EXPECT_TRUE(c.models[0].run.ran());
}

TEST(Compare, RefusesASceneWithNothingToCompare) {
  const test::ScratchFolder scratch;
  RunOptions run_options;
  run_options.quiet = true;
  RunContext run(run_options, false);
  Scene scene;
  const std::string text = test::replaced(ball, "{type: translucent, sigma_a: 0.05, sigma_s: 4}",
                                          "{type: diffuse, reflectance: 0.5}");
  EXPECT_THROW(compare_models(scratch.write("ball.yaml", text), {}, run, scene), InputError);
}

}  // namespace
}  // namespace knotlight
