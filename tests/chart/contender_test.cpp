#include "chart/contender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace knotlight {
namespace {

Scene ball(double ior) {
  Scene scene;
  TranslucentMaterial wax;
  wax.ior = ior;
  scene.objects = {{"ball", Sphere{Vec3::Zero(), 1.0}, wax}};
  return scene;
}

SolverSettings as_it_is(double) {
  return {};
}

TEST(Contenders, OursThenCoarseOnesFirstAndEachOnce) {
  const std::vector<Contender> all = contenders(ball(1.0), as_it_is, 3);
  const auto ours = [](const auto& c) {
    return c.line == default_line || c.line == our_field_line;
  };
  EXPECT_TRUE(std::is_partitioned(all.begin(), all.end(), ours));
  EXPECT_TRUE(std::is_sorted(std::partition_point(all.begin(), all.end(), ours), all.end(),
                             [](const auto& a, const auto& b) { return a.level < b.level; }));
  EXPECT_EQ(all.back().level, 2);
  std::set<std::string> lines;
  for (const Contender& c : all) lines.insert(c.line);
  EXPECT_EQ(all.size(), 3U * lines.size());
  for (const char* line : {default_line, "grid", "lbkm", "mfs", "bkm", "bkm_thesis, photon_map",
                           dipole_line, path_tracing_line})
    EXPECT_TRUE(lines.count(line)) << line;
}

TEST(Contenders, TraceThePhotonsTheyName) {
  Scene scene = ball(1.0);
  scene.solver.photons_at_most = true;
  for (const Contender& c : contenders(scene, as_it_is, 2)) {
    EXPECT_FALSE(c.solver.photons_at_most) << c.name();
  }
}

TEST(Contenders, DefaultLineIsWhatTheSceneChooses) {
  const auto chosen = [](double tolerance) {
    SolverSettings settings;
    settings.method = Method::mfs;
    settings.photons = static_cast<std::size_t>(1e4 / tolerance);
    return settings;
  };
  for (const Contender& c : contenders(ball(1.0), chosen, 2)) {
    if (c.line != default_line) continue;
    EXPECT_EQ(c.solver.method, Method::mfs);
    EXPECT_EQ(c.solver.photons, c.level == 0 ? 62'500U : 125'000U);
  }
}

// A gathered picture of a refracting object needs photons in it, which these sources do not have.
TEST(Contenders, SourcesWithoutPhotonsAreNotGatheredUnderRefraction) {
  for (const double ior : {1.0, 1.4})
    for (const Contender& c : contenders(ball(ior), as_it_is, 1)) {
      if (c.line != "grid, irradiance_sampling") continue;
      EXPECT_EQ(c.solver.exitance, ior == 1.0 ? Exitance::gather : Exitance::p1);
    }
}

}  // namespace
}  // namespace knotlight
