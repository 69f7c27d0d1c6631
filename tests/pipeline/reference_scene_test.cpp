#include "pipeline/reference_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/errors.h"
#include "core/image_io.h"
#include "pipeline/scene_setup.h"
#include "reference/path_film.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

const char* const sphere_scene = R"(
camera: {type: orthographic, from: [0, 0, 5], to: [0, 0, 0], up: [0, 1, 0], width: 2.4, resolution: [16, 12], samples: 8}
lights: [{type: point, position: [3, 0, 3], intensity: 18}]
materials: {wax: {type: translucent, sigma_a: 0.1, sigma_s: 10}}
objects: [{name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}]
)";

RunContext quiet_run(std::vector<std::string> overrides = {}, std::uint64_t seed = 1) {
  RunOptions options;
  options.quiet = true;
  options.seed = seed;
  options.overrides = std::move(overrides);
  return {options, false};
}

TEST(ReferenceScene, WritesBothPicturesAndSaysWhatOnePercentCosts) {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.yaml", sphere_scene);
  RunContext run = quiet_run();
  const ReferenceSummary s =
      reference_scene(scene, {folder.path("a.exr"), folder.path("a.png")}, std::nullopt, run);
  EXPECT_EQ(s.samples, 8U);
  EXPECT_EQ(s.resumed_samples, 0U);
  EXPECT_EQ(s.unfound_share, 0.0);
  EXPECT_TRUE(s.failures().empty());
  EXPECT_NEAR(s.samples_for_1_percent(), 8.0 * std::pow(s.noise / 0.01, 2), 1e-6);
  const LayeredImage picture = read_layers(folder.path("a.exr"));
  EXPECT_EQ(picture.width, 16);
  EXPECT_GT(picture.values("R")[6 * 16 + 10], 0.0F);
  EXPECT_GT(picture.values("variance.G")[6 * 16 + 10], 0.0F);
  EXPECT_EQ(read_image(folder.path("a.png")).height, 12);
  EXPECT_FALSE(fs::exists(folder.path("a.exr.part")));
  EXPECT_NE(describe(s).find("1 % noise per pixel would take about"), std::string::npos);
  EXPECT_NE(reference_json(s, run).find("\"samples_for_1_percent\""), std::string::npos);
}

// What an interrupted run has left is taken up, and the picture has the same bits.
TEST(ReferenceScene, GoesOnWhereItWasInterrupted) {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.yaml", sphere_scene);
  RunContext run = quiet_run();
  reference_scene(scene, {folder.path("whole.exr")}, 8, run);

  const PreparedScene prepared = prepare_scene(scene, run);
  PathFilm film(prepared.scene.camera);
  {
    Stage stage(run.stages, "samples", 0);
    add_samples(film, PathTracer(prepared.scene, *prepared.caster), prepared.scene.camera, 1, 3,
                run.workers, stage);
  }
  const std::string part = folder.path("resumed.exr.part");
  write_film(part, film, samples_key(prepared.scene, 1));

  RunContext other_seed = quiet_run({}, 2);
  EXPECT_THROW(reference_scene(scene, {folder.path("resumed.exr")}, 8, other_seed), InputError);
  RunContext other_scene = quiet_run({"materials.wax.sigma_a=0.2"});
  EXPECT_THROW(reference_scene(scene, {folder.path("resumed.exr")}, 8, other_scene), InputError);
  EXPECT_TRUE(fs::exists(part));

  const ReferenceSummary s = reference_scene(scene, {folder.path("resumed.exr")}, 8, run);
  EXPECT_EQ(s.samples, 8U);
  EXPECT_EQ(s.resumed_samples, 3U);
  EXPECT_FALSE(fs::exists(part));
  const LayeredImage whole = read_layers(folder.path("whole.exr"));
  const LayeredImage resumed = read_layers(folder.path("resumed.exr"));
  for (const Layer& layer : whole.layers)
    EXPECT_EQ(resumed.values(layer.channel), layer.values) << layer.channel;
}

TEST(ReferenceScene, SaysWhatItCannotFind) {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.yaml", sphere_scene);
  // A thin refracting ball mirrors the lamp's light inside before it is scattered.
  RunContext thin = quiet_run({"materials.wax.ior=1.5", "materials.wax.sigma_s=0.1"});
  const ReferenceSummary s = reference_scene(scene, {folder.path("a.exr")}, 2, thin);
  EXPECT_GT(s.unfound_share, 0.01);
  EXPECT_EQ(s.failures().size(), 1U);
  RunContext rough = quiet_run({"materials.wax.ior=1.5", "materials.wax.roughness=0.4"});
  EXPECT_THROW(reference_scene(scene, {folder.path("a.exr")}, 2, rough), InputError);
}

}  // namespace
}  // namespace knotlight
