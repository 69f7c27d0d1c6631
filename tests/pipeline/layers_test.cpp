#include "pipeline/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "pipeline/glow.h"
#include "pipeline/render_scene.h"
#include "render/picture.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::ScratchFolder;

RunContext quiet_run(int threads = 0) {
  RunOptions options;
  options.quiet = true;
  options.threads = threads;
  return {options, false};
}

constexpr double half_width = 1.2;  // of the orthographic pictures below
constexpr int side = 24;            // pixels

// A unit ball, object 1, behind a diffuse square that covers x > 1/2 at z = 2; the eye looks down
// from z = 5.
Scene ball_scene() {
  Scene scene;
  scene.units = "mm";
  scene.camera.type = Camera::Type::orthographic;
  scene.camera.from = {0, 0, 5};
  scene.camera.up = Vec3::UnitY();
  scene.camera.width = 2.0 * half_width;
  scene.camera.width_px = scene.camera.height_px = side;
  scene.camera.samples = 2;
  TranslucentMaterial wax;
  wax.sigma_a = Spectrum::Constant(0.1);
  wax.sigma_s = Spectrum::Constant(5.0);
  scene.objects = {{"screen", quad_mesh({1.5, 0, 2}, {1, 0, 0}, {0, 5, 0}), DiffuseMaterial{}},
                   {"ball", Sphere{Vec3::Zero(), 1.0}, wax}};
  scene.lights = {DirectionalLight{Vec3::UnitZ(), Spectrum::Constant(2.0)}};
  scene.solver.tolerance = 0.05;
  scene.solver.photons = 50'000;
  return scene;
}

struct Rendered {
  PreparedScene prepared;
  SolvedScene solved;
  GlowingSurfaces surfaces;
  Image picture;
  PictureLayers layers;

  Rendered(Scene scene, const std::string& names, int threads = 0)
      : prepared(prepare_scene(std::move(scene))) {
    RunContext run = quiet_run(threads);
    choose_for_picture(prepared.scene.solver);
    solved = solve_scene(prepared, run);
    surfaces = glowing_surfaces(prepared, solved, run);
    const Shading shading(prepared.scene, *prepared.caster, surfaces);
    PictureParts parts;
    Stage stage(run.stages, "picture", picture_tiles(prepared.scene.camera));
    picture = render_picture(prepared.scene.camera, shading, run.options.seed, run.workers, stage,
                             &parts);
    layers = picture_layers(chosen_layers(names), prepared, solved, surfaces, shading, parts, run);
  }
  const std::vector<float>& values(const std::string& channel) const {
    for (const Layer& layer : layers.channels)
      if (layer.channel == channel) return layer.values;
    throw std::runtime_error("no channel " + channel);
  }
};

double at_pixel(int i) {
  return half_width * (2.0 * (i + 0.5) / side - 1.0);
}

// Calls body(pixel, x, y) for each pixel that shows the ball, or each that does not.
template <typename Body>
void for_pixels(bool of_ball, const Body& body) {
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double x = at_pixel(column), y = -at_pixel(row);
      if ((x <= 0.5 && x * x + y * y < 1.0) == of_ball)
        body(static_cast<std::size_t>(row * side + column), x, y);
    }
}

constexpr double single_precision = 1e-5;

TEST(Layers, ShapesOfABallBehindAScreen) {
  const Rendered r(ball_scene(), "depth,position,normal,object");
  for_pixels(true, [&](std::size_t i, double x, double y) {
    const double z = std::sqrt(1.0 - x * x - y * y);
    EXPECT_NEAR(r.values("depth")[i], 5.0 - z, single_precision);
    EXPECT_NEAR(r.values("position.X")[i], x, single_precision);
    EXPECT_NEAR(r.values("position.Y")[i], y, single_precision);
    EXPECT_NEAR(r.values("position.Z")[i], z, single_precision);
    EXPECT_NEAR(r.values("normal.X")[i], x, single_precision);
    EXPECT_NEAR(r.values("normal.Y")[i], y, single_precision);
    EXPECT_NEAR(r.values("normal.Z")[i], z, single_precision);
    EXPECT_EQ(r.values("object")[i], 1.0F);
  });
  for_pixels(false, [&](std::size_t i, double x, double) {
    const bool screen = x > 0.5;
    EXPECT_EQ(r.values("object")[i], screen ? 0.0F : -1.0F);
    EXPECT_EQ(r.values("normal.Z")[i], screen ? 1.0F : 0.0F);
    if (screen) {
      EXPECT_NEAR(r.values("depth")[i], 3.0, single_precision);
    } else {
      EXPECT_EQ(r.values("depth")[i], std::numeric_limits<float>::infinity());
    }
  });
}

// The beam comes from below: what the eye sees of U_ri has crossed the ball, E exp(-sigma_t 2 z) /
// (4 pi). The source is 3 sigma_s (sigma_tr + g sigma_t) U_ri + 3 sigma_tr / (4 pi) E.
TEST(Layers, LightThatHasCrossedTheBallAndItsSource) {
  Scene scene = ball_scene();
  auto& wax = std::get<TranslucentMaterial>(scene.objects[1].material);
  wax.sigma_s = Spectrum::Constant(1.0);
  wax.g = Spectrum::Constant(0.5);
  wax.emission = Spectrum::Constant(0.3);
  const Rendered r(std::move(scene), "U_ri,source,U_d,fluence");
  for_pixels(true, [&](std::size_t i, double x, double y) {
    const double U_ri = 2.0 * std::exp(-1.1 * 2.0 * std::sqrt(1.0 - x * x - y * y)) / (4.0 * pi);
    for (const char* channel : {"U_ri.R", "U_ri.G", "U_ri.B"})
      EXPECT_NEAR(r.values(channel)[i], U_ri, single_precision);
    EXPECT_NEAR(r.values("source.R")[i],
                3.0 * (0.6 + 0.5 * 1.1) * U_ri + 3.0 * 0.6 / (4.0 * pi) * 0.3, single_precision);
    EXPECT_GT(r.values("U_d.G")[i], 0.0F);
    EXPECT_NEAR(r.values("fluence.G")[i], 4.0 * pi * (r.values("U_d.G")[i] + U_ri), 1e-4);
  });
  for_pixels(false, [&](std::size_t i, double, double) {
    for (const char* channel : {"U_ri.R", "source.R", "U_d.R", "fluence.R"})
      EXPECT_EQ(r.values(channel)[i], 0.0F);
  });
}

// A ball that absorbs nothing under an even sky of radiance 1 is full of that radiance: fluence 4
// pi everywhere. Half of it is U_ri, exact; diffusion's U_d on the surface of a ball of 5 mean free
// paths is 10 % too large. Noise of the mean over 300 pixels: below 0.5 %.
TEST(Layers, FluenceInAWhiteFurnace) {
  const std::vector<std::pair<std::optional<SourceModel>, double>> cases = {
      {std::nullopt, 0.0},
      {SourceModel::photon_map, 0.0},
      {SourceModel::photon_map, 0.7},
      {SourceModel::boundary_flux, 0.0}};
  for (const auto& [source, g] : cases) {
    Scene scene = ball_scene();
    scene.objects.erase(scene.objects.begin());
    auto& wax = std::get<TranslucentMaterial>(scene.objects[0].material);
    wax.sigma_a = Spectrum::Zero();
    scene.camera.samples = 64;
    wax.g = Spectrum::Constant(g);
    scene.lights = {EnvironmentLight{Spectrum::Ones(), nullptr}};
    scene.solver.source = source;
    const Rendered r(std::move(scene), "fluence,U_ri,object");
    double sum = 0.0;
    int pixels = 0;
    for (std::size_t i = 0; i < side * side; ++i)
      if (r.values("object")[i] == 0.0F) {
        sum += r.values("fluence.R")[i];
        ++pixels;
      }
    EXPECT_NEAR(sum / pixels / (4.0 * pi), 1.0, 0.06);
  }
}

// What is left of the boundary condition at a place is the error of the derivative in the cell
// there, of first order: cells half as large (a quarter of the tolerance) leave half as much. A
// wrong sign or a missing right-hand side, which is 8 times the rms of U_d with P1 and g = 0.6,
// would stay.
TEST(Layers, ResidualFallsWithTheCells) {
  const std::vector<std::pair<double, Diffusion>> cases = {
      {0.0, Diffusion::asymptotic}, {0.6, Diffusion::asymptotic}, {0.6, Diffusion::p1}};
  for (const auto& [g, diffusion] : cases) {
    std::vector<double> means;
    for (const double tolerance : {0.05, 0.0125}) {
      Scene scene = ball_scene();
      std::get<TranslucentMaterial>(scene.objects[1].material).g = Spectrum::Constant(g);
      scene.lights = {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}};
      scene.solver.diffusion = diffusion;
      scene.solver.tolerance = tolerance;
      const Rendered r(std::move(scene), "robin_residual");
      EXPECT_TRUE(r.layers.warnings.empty());
      double sum = 0.0;
      int pixels = 0;
      for_pixels(true, [&](std::size_t i, double x, double y) {
        if (x * x + y * y > 0.5) return;  // nearer the rim the light grazes
        sum += r.values("robin_residual.R")[i];
        ++pixels;
      });
      means.push_back(sum / pixels);
    }
    EXPECT_GT(means[1], 0.0);
    EXPECT_LT(means[1], 0.65 * means[0]) << g;
  }
}

// Lit from where the eye is, along a chord of length c, light scattered once is E sigma_s / (4 pi)
// (1 - exp(-2 sigma_t c)) / (2 sigma_t); nothing stands around the ball that could shine.
TEST(Layers, LightScatteredOnceAndMoreIsThePicture) {
  Scene scene = ball_scene();
  scene.objects.erase(scene.objects.begin());
  scene.lights = {DirectionalLight{-Vec3::UnitZ(), Spectrum::Constant(2.0)}};
  scene.camera.samples = 16;
  const Rendered r(std::move(scene), "single,multiple");
  double single = 0.0, expected = 0.0;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const auto i = static_cast<std::size_t>(row * side + column);
      const double once = r.values("single.G")[i], more = r.values("multiple.G")[i];
      EXPECT_NEAR(once + more, r.picture.pixels[i][1], 1e-6);
      const double x = at_pixel(column), y = -at_pixel(row);
      if (x * x + y * y > 0.8) continue;  // pixels that lie wholly on the ball
      EXPECT_GT(more, 0.0);
      const double chord = 2.0 * std::sqrt(1.0 - x * x - y * y);
      single += once;
      expected += 2.0 * 5.0 / (4.0 * pi) * -std::expm1(-2.0 * 5.1 * chord) / (2.0 * 5.1);
    }
  // Over 300 pixels with 16 depths each, whose weights 2 exp(-sigma_t s) have a standard deviation
  // of 0.58 were they not spread evenly: 0.8 %. Five of these: false alarms 6e-7.
  EXPECT_NEAR(single / expected, 1.0, 0.04);
}

TEST(Layers, NoSingleScatteringWhereItIsNotToldApart) {
  for (const bool gathers : {false, true}) {
    Scene scene = ball_scene();
    if (gathers)
      scene.solver.source = SourceModel::boundary_flux;
    else
      scene.solver.exitance = Exitance::p1;
    const Rendered r(std::move(scene), "single,multiple,object");
    ASSERT_EQ(r.layers.warnings.size(), 2U);
    EXPECT_EQ(r.layers.warnings[0].find("layer single is left out"), 0U) << r.layers.warnings[0];
    EXPECT_EQ(r.layers.channels.size(), 1U);
  }
}

TEST(Layers, ErrorEstimateIsTheReports) {
  const Rendered r(ball_scene(), "error_estimate");
  const auto estimate = static_cast<float>(r.solved.objects[0][0].report.error_estimate);
  for_pixels(true, [&](std::size_t i, double, double) {
    EXPECT_EQ(r.values("error_estimate.B")[i], estimate);
  });
  for_pixels(false, [&](std::size_t i, double, double) {
    EXPECT_EQ(r.values("error_estimate.R")[i], 0.0F);
  });
}

TEST(Layers, NoResidualWhereTheMethodHasNone) {
  Scene scene = ball_scene();
  scene.solver.method = Method::mfs;
  const Rendered r(std::move(scene), "robin_residual,depth");
  ASSERT_EQ(r.layers.warnings.size(), 1U);
  EXPECT_EQ(r.layers.warnings[0],
            "layer robin_residual is left out: object 'ball' was solved by mfs, expected a "
            "solution by grid");
  ASSERT_EQ(r.layers.channels.size(), 1U);
  EXPECT_EQ(r.layers.channels[0].channel, "depth");
}

// Neither the number of threads nor the other layers change a layer.
TEST(Layers, SameBitsAlways) {
  Scene scene = ball_scene();
  scene.lights.push_back(AreaLight{{0, 0, 4}, {1, 0, 0}, {0, -1, 0}, Spectrum::Ones()});
  const Rendered all(scene, "all", 2);
  for (const char* name : {"fluence", "U_d", "U_ri", "source", "robin_residual", "single"}) {
    const Rendered alone(scene, name, 1);
    const std::string red = std::string(name) + ".R";
    EXPECT_EQ(alone.values(red), all.values(red)) << name;
  }
}

TEST(Layers, Names) {
  EXPECT_EQ(chosen_layers("depth,U_d,depth"), (std::vector<std::string>{"U_d", "depth"}));
  EXPECT_EQ(chosen_layers("depth,all"), chosen_layers("all"));
  EXPECT_EQ(chosen_layers("all").size(), 12U);
  for (const char* wrong : {"detph", "", "depth,", "depth, normal"})
    EXPECT_THROW(chosen_layers(wrong), InputError) << wrong;
  try {
    chosen_layers("detph");
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "--layers: there is no layer 'detph' (did you mean 'depth'?), expected all or some "
        "of fluence,U_d,U_ri,source,robin_residual,error_estimate,single,multiple,depth,position,"
        "normal,object");
  }
}

// R, G, B of the file are those of the picture without layers, bit for bit.
TEST(Layers, LeaveThePictureAsItIs) {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.yaml", R"(
units: mm
camera: {type: orthographic, from: [0, 0, 5], to: [0, 0, 0], up: [0, 1, 0], width: 2.4, resolution: [20, 16], samples: 4}
lights: [{type: point, position: [3, 0, 3], intensity: 18}, {type: environment, radiance: 0.1}]
materials: {wax: {type: translucent, sigma_a: [0.1, 0.2, 0.3], sigma_s: 5}}
objects: [{name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}]
solver: {photons: 20000, tolerance: 0.1}
)");
  RunContext run = quiet_run();
  Scene read;
  render_scene(scene, {{folder.path("plain.exr")}, {}}, run, read);
  render_scene(scene,
               {{folder.path("layers.exr"), folder.path("layers.png")}, chosen_layers("all")}, run,
               read);
  const LayeredImage plain = read_layers(folder.path("plain.exr"));
  const LayeredImage layered = read_layers(folder.path("layers.exr"));
  EXPECT_EQ(plain.layers.size(), 3U);
  EXPECT_EQ(layered.layers.size(), 3U + 8U * 3U + 2U * 3U + 2U);
  for (const char* channel : {"R", "G", "B"})
    EXPECT_EQ(layered.values(channel), plain.values(channel)) << channel;
  EXPECT_EQ(read_image(folder.path("layers.png")).width, 20);
}

}  // namespace
}  // namespace knotlight
