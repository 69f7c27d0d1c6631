#include "pipeline/solution_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.h"
#include "pipeline/glow.h"
#include "pipeline/render_scene.h"
#include "support/program.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using test::read_file;
using test::ScratchFolder;

const char* const small_scene = R"(
units: mm
camera: {type: orthographic, from: [0, 0, 5], to: [0, 0, 0], up: [0, 1, 0], width: 3, resolution: [16, 12], samples: 1}
lights: [{type: point, position: [3, 0, 3], intensity: 18}]
materials:
  wax: {type: translucent, sigma_a: [0.1, 0.2, 0.3], sigma_s: 2}
  floor: {type: diffuse, reflectance: 0.3}
objects:
  - {name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}
  - {name: brick, box: {min: [1.2, -0.5, -0.5], max: [2, 0.5, 0.5]}, material: wax}
  - {name: table, quad: {center: [0, 0, -1.5], u: [3, 0, 0], v: [0, 3, 0]}, material: floor}
solver: {photons: 12000, tolerance: 0.5}
)";

// As an override: dense least squares and loops over damaged files are for one small object.
const char* const ball_alone =
    "objects=[{name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}]";

const char* const grey = "materials.wax.sigma_a=0.1";

RunContext quiet_run(std::vector<std::string> overrides = {}, std::uint64_t seed = 1) {
  RunOptions options;
  options.quiet = true;
  options.seed = seed;
  options.overrides = std::move(overrides);
  return {options, false};
}

class SolutionFile : public testing::Test {
 protected:
  void SetUp() override { scene_ = folder_.write("scene.yaml", small_scene); }

  // Solves and keeps the solution in file.klsol.
  Report save(const std::string& picture, const std::vector<std::string>& overrides = {}) {
    return render({{folder_.path(picture)}, {}, "", file()}, overrides);
  }
  Report reuse(const std::string& picture, const std::vector<std::string>& overrides = {}) {
    return render({{folder_.path(picture)}, {}, file(), ""}, overrides);
  }
  Report solve(const std::string& picture, const std::vector<std::string>& overrides = {}) {
    return render({{folder_.path(picture)}, {}, "", ""}, overrides);
  }
  Report render(const RenderFiles& files, const std::vector<std::string>& overrides) {
    RunContext run = quiet_run(overrides, seed_);
    Scene scene;
    return render_scene(scene_, files, run, scene);
  }
  // What reading the solution for a changed scene says.
  std::string refusal(const std::vector<std::string>& overrides) {
    try {
      reuse("refused.exr", overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  std::string file() const { return folder_.path("file.klsol"); }
  bool same_picture(const std::string& a, const std::string& b) const {
    const Image one = read_image(folder_.path(a)), two = read_image(folder_.path(b));
    return one.width == two.width &&
           std::equal(one.pixels.begin(), one.pixels.end(), two.pixels.begin(), two.pixels.end(),
                      [](const Spectrum& x, const Spectrum& y) { return (x == y).all(); });
  }

  ScratchFolder folder_;
  std::string scene_;
  std::uint64_t seed_ = 1;
};

// By a grid, by a boundary method, with light that is diffuse from the start: the same bits.
TEST_F(SolutionFile, PicturesAreThoseOfTheFreshSolution) {
  int pictures = 0;
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"solver.method=grid", "materials.wax.ior=1.3"},
        {"solver.method=mfs", ball_alone, grey},
        {"materials.wax.g=0.5", ball_alone, grey},
        {"solver.method=mfs", "solver.exitance=p1", ball_alone, grey},
        {"solver.source=boundary_flux", "materials.wax.ior=1.3", ball_alone, grey}}) {
    const std::string fresh = fmt::format("fresh{}.exr", pictures);
    const std::string read = fmt::format("read{}.exr", pictures++);
    save(fresh, how);
    const Report report = reuse(read, how);
    EXPECT_TRUE(same_picture(fresh, read)) << how[0];
    EXPECT_FALSE(report.objects.empty());
  }
}

TEST_F(SolutionFile, AnotherCameraAndAnotherExitance) {
  const std::vector<std::string> p1 = {"solver.diffusion=p1"};
  save("first.exr", p1);
  for (const char* change : {"camera.from=[3, -2, 5]", "camera.resolution=[12, 9]",
                             "camera.samples=5", "solver.exitance=lambert"}) {
    const std::string fresh = fmt::format("fresh {}.exr", change);
    const std::string read = fmt::format("read {}.exr", change);
    solve(fresh, {p1[0], change});
    reuse(read, {p1[0], change});
    EXPECT_TRUE(same_picture(fresh, read)) << change;
    EXPECT_FALSE(same_picture("first.exr", read)) << change;
  }
}

// A solution that is not to be trusted stays so, in the same words.
TEST_F(SolutionFile, KeepsItsReport) {
  const std::vector<std::string> how = {"solver.tolerance=0.02", "solver.exitance=p1"};
  const Report fresh = save("fresh.exr", how);
  const Report read = reuse("read.exr", how);
  EXPECT_FALSE(fresh.failures.empty());
  EXPECT_EQ(read.failures, fresh.failures);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.objects[i].name, fresh.objects[i].name);
    EXPECT_EQ(read.objects[i].method, fresh.objects[i].method);
    EXPECT_EQ(read.objects[i].validity[1].lambda_R, fresh.objects[i].validity[1].lambda_R);
    EXPECT_EQ(read.objects[i].channels[2].figures, fresh.objects[i].channels[2].figures);
    EXPECT_EQ(read.objects[i].channels[2].error_estimate,
              fresh.objects[i].channels[2].error_estimate);
  }
}

TEST_F(SolutionFile, RefusesAnotherScene) {
  save("fresh.exr");
  const auto expect = [&](const std::string& override, const std::string& what) {
    EXPECT_EQ(refusal({override}), file() + ": is of another scene: " + what +
                                       " differs, expected the same but for the camera");
  };
  expect("lights.0.intensity=19", "lights.0");
  expect("lights.0.position=[3, 0, 3.1]", "lights.0");
  expect(
      "lights=[{type: point, position: [3, 0, 3], intensity: 18}, {type: environment, radiance: "
      "1}]",
      "the number of lights");
  expect("materials.wax.sigma_s=2.01", "the material of object 'ball'");
  expect("materials.floor.reflectance=0.4", "the material of object 'table'");
  expect("objects.brick.translate=[0, 0, 0.1]", "the shape of object 'brick'");
  expect("objects.ball.sphere.radius=1.01", "the shape of object 'ball'");
  expect("solver.photons=12001", "solver.photons");
  expect("solver.tolerance=0.51", "solver.tolerance");
  expect("solver.boundary=marshak", "solver.boundary");
  expect("solver.exitance=p1", "solver.diffusion (left out: the one that goes with the exitance)");
  expect("solver.method=grid", "solver.method");
  expect("units=cm", "units");
  seed_ = 2;
  expect("camera.samples=3", "the seed");
}

TEST_F(SolutionFile, SaysWhatItLacks) {
  const std::vector<std::string> outside = {"solver.method=mfs", ball_alone, grey,
                                            "solver.diffusion=p1", "solver.exitance=p1"};
  save("fresh.exr", outside);
  EXPECT_EQ(refusal({outside[0], outside[1], outside[2], outside[3]}),
            file() +
                ": has nothing from inside object 'ball', expected one saved with "
                "solver.exitance gather");
}

// Cut off anywhere, or with any byte changed, it is refused: every place within the first and last
// 150 bytes, 200 places between.
TEST_F(SolutionFile, RefusesWhatIsDamaged) {
  const std::vector<std::string> small = {ball_alone, grey, "solver.tolerance=0.9"};
  save("fresh.exr", small);
  RunContext run = quiet_run(small);
  PreparedScene prepared = prepare_scene(scene_, run);
  choose_for_picture(prepared.scene.solver);
  const std::string whole = read_file(file());
  EXPECT_NO_THROW(read_solution(file(), prepared, run));
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < 150; ++i) {
    places.push_back(i);
    places.push_back(whole.size() - 1 - i);
  }
  for (std::size_t i = 0; i < 200; ++i) places.push_back(150 + i * (whole.size() - 300) / 200);
  for (const std::size_t place : places) {
    EXPECT_THROW(read_solution(folder_.write("cut", whole.substr(0, place)), prepared, run),
                 InputError)
        << place;
    std::string flipped = whole;
    flipped[place] = static_cast<char>(flipped[place] ^ 1);
    EXPECT_THROW(read_solution(folder_.write("flipped", flipped), prepared, run), InputError)
        << place;
  }
  for (const std::string& garbage : {std::string(), std::string("garbage"), whole + "x",
                                     std::string(1000, '\0'), "knotlight solution 2\n" + whole})
    EXPECT_THROW(read_solution(folder_.write("garbage", garbage), prepared, run), InputError);
  EXPECT_THROW(read_solution(folder_.path("none"), prepared, run), InputError);
  EXPECT_THROW(read_solution(folder_.folder().string(), prepared, run), InputError);
}

}  // namespace
}  // namespace knotlight
