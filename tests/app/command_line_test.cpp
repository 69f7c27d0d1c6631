// The program as a user meets it: exit codes, files, bits.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/image_io.h"
#include "support/program.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using test::ProgramResult;
using test::read_file;
using test::run_program;
using test::ScratchFolder;

// Small enough for a test of well under a second.
const char* const small_scene = R"(units: mm
camera: {type: perspective, from: [0, -6, 2], to: [0, 0, 0], up: [0, 0, 1], fov: 35, resolution: [32, 24], samples: 4}
lights:
  - {type: point, position: [3, -1, 3], intensity: 18}
materials:
  wax: {type: translucent, sigma_a: [0.02, 0.05, 0.2], sigma_s: 5, ior: 1.2}
  floor: {type: diffuse, reflectance: 0.5}
objects:
  - {name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}
  - {name: table, quad: {center: [0, 0, -1], u: [5, 0, 0], v: [0, 5, 0]}, material: floor}
solver: {photons: 20000, knots: 60, tolerance: 0.3}
)";

class CommandLine : public testing::Test {
 protected:
  void SetUp() override { scratch_.write("scene.yaml", small_scene); }

  ProgramResult run(const std::string& arguments) const {
    return run_program(KNOTLIGHT_PROGRAM, arguments, scratch_.folder());
  }
  bool exists(const std::string& name) const {
    return std::filesystem::exists(scratch_.path(name));
  }

  ScratchFolder scratch_;
};

// Exactly one line on standard error, with everything in it, exit code 2, nothing written.
void expect_bad_input(const ProgramResult& result, const std::string& expected) {
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(CommandLine, VersionNamesProgramVersionAndCommit) {
  const ProgramResult result = run("--version");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.rfind("knotlight " KNOTLIGHT_VERSION " (", 0), 0U) << result.out;
}

TEST_F(CommandLine, RenderWritesExrAndPngUnderTheScenesName) {
  const ProgramResult result = run("render scene.yaml");
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
  EXPECT_EQ(result.out, "scene.exr\nscene.png\n");
  EXPECT_TRUE(exists("scene.exr"));
  EXPECT_TRUE(exists("scene.png"));
}

TEST_F(CommandLine, OneAndTwoThreadsGiveTheSameFile) {
  run("render scene.yaml -o one.exr --threads 1");
  run("render scene.yaml -o two.exr --threads 2");
  const std::string one = read_file(scratch_.path("one.exr"));
  EXPECT_GT(one.size(), 1000U);
  EXPECT_TRUE(one == read_file(scratch_.path("two.exr")));  // not EXPECT_EQ: no bytes in the log
}

TEST_F(CommandLine, AnotherSeedGivesAnotherFile) {
  run("render scene.yaml -o one.exr --seed 1");
  run("render scene.yaml -o two.exr --seed 2");
  EXPECT_TRUE(read_file(scratch_.path("one.exr")) != read_file(scratch_.path("two.exr")));
}

TEST_F(CommandLine, UntrustedNumbersEndWithThreeAndMarkThePicture) {
  const ProgramResult result = run(
      "render scene.yaml -o a.exr --set solver.tolerance=0.002 --set solver.photons=12000 --json "
      "a.json");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("not to be trusted"), std::string::npos);
  EXPECT_TRUE(exists("a.exr"));
  EXPECT_NE(read_file(scratch_.path("a.exr")).find("knotlight:trusted"), std::string::npos);
  const auto json = nlohmann::json::parse(read_file(scratch_.path("a.json")));
  EXPECT_FALSE(json["trusted"].get<bool>());
  EXPECT_FALSE(json["failures"].empty());
}

// One photon that meets nothing leaves the object dark: that must not pass for a result.
TEST_F(CommandLine, HardlyAnyPhotonsAreNotTrusted) {
  const ProgramResult result = run("render scene.yaml -o a.exr --set solver.photons=1");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("too few"), std::string::npos) << result.err;
}

TEST_F(CommandLine, SummaryHoldsWhatWasMeasured) {
  run("render scene.yaml -o a.exr --json a.json --set solver.method=bkm_thesis");
  run("render scene.yaml -o b.exr --json b.json --set solver.method=grid");
  const auto grid = nlohmann::json::parse(read_file(scratch_.path("b.json")));
  EXPECT_EQ(grid["objects"][0]["cells"].size(), 3U);
  EXPECT_TRUE(grid["seconds"].contains("grid"));
  const auto json = nlohmann::json::parse(read_file(scratch_.path("a.json")));
  for (const char* stage : {"scene", "geometry", "photons", "solve", "surface", "picture", "write"})
    EXPECT_TRUE(json["seconds"].contains(stage)) << stage;
  EXPECT_GT(json["peak_memory_MiB"].get<double>(), 1.0);
  const auto& ball = json["objects"][0];
  EXPECT_EQ(ball["name"], "ball");
  for (const char* key :
       {"robin_residual", "source_residual", "error_estimate", "noise", "energy_imbalance",
        "particular_rank", "homogeneous_condition", "photons"})
    EXPECT_EQ(ball[key].size(), 3U) << key;
  EXPECT_EQ(ball["boundary_knots"][0], 60);
}

// The photon audit: fractions of the incident power add up to one with the surface reflection.
TEST_F(CommandLine, InfoAuditsThePhotons) {
  const ProgramResult result = run("info scene.yaml --set materials.wax.sigma_a=0.05 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  const auto& ball = json["objects"][0];
  EXPECT_NEAR(ball["lambda_R"].get<double>(), std::sqrt(3 * 0.05 * 5.05), 1e-12);
  EXPECT_NEAR(ball["size_in_mean_free_paths"].get<double>(), 2 * 5.05, 1e-12);
  EXPECT_NEAR(ball["reduced_albedo"].get<double>(), 5.0 / 5.05, 1e-12);
  EXPECT_TRUE(ball["valid"].get<bool>());
  EXPECT_NEAR(ball["reflected_fraction"].get<double>() + ball["absorbed_fraction"].get<double>() +
                  ball["escaped_fraction"].get<double>() + ball["lost_fraction"].get<double>(),
              1.0, 1e-9);
  EXPECT_GT(ball["standard_error"].get<double>(), 0.0);
}

TEST_F(CommandLine, InfoSaysWhereDiffusionDoesNotHold) {
  const ProgramResult result = run("info scene.yaml --set materials.wax.sigma_s=0.1");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("does not hold"), std::string::npos) << result.out;
}

TEST_F(CommandLine, ProbeKnowsInsideSurfaceAndOutside) {
  scratch_.write("in.csv", "id,x,y,z\na,0,0,0\nb,1.001,0,0\nc,1.1,0,0\n\nd, 0 ,0.5 , 0\n");
  const ProgramResult result = run("probe scene.yaml --points in.csv -o out.csv");
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
  std::ifstream in(scratch_.path("out.csv"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "x,y,z,U_d.0,U_ri.0,U_d.1,U_ri.1,U_d.2,U_ri.2,status");
  for (const char* status : {",ok", ",ok", ",outside", ",ok"}) {
    ASSERT_TRUE(std::getline(in, line));
    EXPECT_EQ(line.substr(line.rfind(',')), status) << line;
  }
  EXPECT_FALSE(std::getline(in, line));
}

// The part of U_d that pictures beyond P1 are made from is not what a point has.
TEST_F(CommandLine, ProbeIsAlwaysP1) {
  scratch_.write("in.csv", "x,y,z\n0,0,0\n0,0.5,0\n");
  run("probe scene.yaml --points in.csv -o plain.csv");
  run("probe scene.yaml --points in.csv -o asymptotic.csv --set solver.diffusion=asymptotic");
  const auto contents = [&](const char* name) {
    std::ifstream in(scratch_.path(name));
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(contents("asymptotic.csv"), contents("plain.csv"));
  EXPECT_NE(contents("plain.csv"), "");
}

TEST_F(CommandLine, QuietPrintsNothing) {
  const ProgramResult result = run("render scene.yaml -o a.exr --quiet --set solver.tolerance=0.9");
  EXPECT_EQ(result.out, "");
  if (result.exit_code == 0) {
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(CommandLine, NoBarsInAPipe) {
  EXPECT_EQ(run("render scene.yaml -o a.exr").err.find('\r'), std::string::npos);
}

TEST_F(CommandLine, WrongWords) {
  expect_bad_input(run("rendr scene.yaml"), "did you mean 'render'?");
  expect_bad_input(
      run(""),
      "render, reference, probe, compare, chart, validate, stability, study, info or view");
  expect_bad_input(run("render"), "scene");
  expect_bad_input(run("render scene.yaml --threads -3"), "--threads");
  expect_bad_input(run("render scene.yaml --seed x"), "--seed");
  expect_bad_input(run("render scene.yaml --seed -1"), "--seed");
  expect_bad_input(run("render scene.yaml --no-such-option"), "--no-such-option");
  expect_bad_input(run("render scene.yaml -o a.jpg"), ".exr or .png");
  expect_bad_input(run("render none.yaml"), "none.yaml");
  expect_bad_input(run("render ."), "");
  expect_bad_input(run("render scene.yaml --set solver.photons=none"), "solver.photons");
  expect_bad_input(run("render scene.yaml --set nonsense"), "--set");
  EXPECT_FALSE(exists("scene.exr"));
  EXPECT_FALSE(exists("a.jpg"));
}

TEST_F(CommandLine, WrongPoints) {
  expect_bad_input(run("probe scene.yaml --points none.csv -o out.csv"), "none.csv");
  scratch_.write("a.csv", "x,y\n1,2\n");
  expect_bad_input(run("probe scene.yaml --points a.csv -o out.csv"), "a.csv:1: z");
  scratch_.write("b.csv", "x,y,z\n0,0,0\n0,zero,0\n");
  expect_bad_input(run("probe scene.yaml --points b.csv -o out.csv"), "b.csv:3: y");
  scratch_.write("c.csv", "x,y,z\n0,nan,0\n");
  expect_bad_input(run("probe scene.yaml --points c.csv -o out.csv"), "c.csv:2: y");
  scratch_.write("d.csv", "");
  expect_bad_input(run("probe scene.yaml --points d.csv -o out.csv"), "d.csv:1");
  EXPECT_FALSE(exists("out.csv"));
}

TEST_F(CommandLine, OverlappingSolidsAreNamed) {
  std::string text = small_scene;
  const std::string second =
      "  - {name: egg, sphere: {center: [0.5, 0, 0], radius: 1}, material: wax}\nsolver:";
  text.replace(text.find("solver:"), 7, second);
  scratch_.write("two.yaml", text);
  const ProgramResult result = run("render two.yaml -o a.exr");
  expect_bad_input(result, "ball");
  EXPECT_NE(result.err.find("egg"), std::string::npos);
}

TEST_F(CommandLine, EyeInsideAnObjectIsRefused) {
  expect_bad_input(run("render scene.yaml --set camera.from=[0.1,0,0]"), "camera.from");
}

TEST_F(CommandLine, OutputFoldersAreCheckedBeforeTheWork) {
  expect_bad_input(run("render scene.yaml -o no/such/folder/a.exr"), "no/such/folder/a.exr");
  expect_bad_input(run("render scene.yaml -o a.exr --json no/a.json"), "no/a.json");
  EXPECT_FALSE(exists("a.exr"));
}

// A link stays a link; what it points at is replaced.
TEST_F(CommandLine, LinksAreFollowed) {
  scratch_.write("real.json", "old");
  std::filesystem::create_symlink("real.json", scratch_.folder() / "link.json");
  run("info scene.yaml --json link.json");
  EXPECT_TRUE(std::filesystem::is_symlink(scratch_.folder() / "link.json"));
  EXPECT_NE(read_file(scratch_.path("real.json")), "old");
}

// SIGINT in the middle of a long run: the program ends at once, with no file, old or half.
TEST_F(CommandLine, CtrlCLeavesNoFile) {
  const std::string script = std::string("timeout --signal=INT --preserve-status 0.5 '") +
                             KNOTLIGHT_PROGRAM +
                             "' render scene.yaml -o a.exr --set solver.photons=500000000";
  scratch_.write("run.sh", script + "\n");
  const ProgramResult result = run_program("/bin/bash", "run.sh", scratch_.folder());
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("interrupted"), std::string::npos);
  for (const auto& entry : std::filesystem::directory_iterator(scratch_.folder()))
    EXPECT_NE(entry.path().extension(), ".exr");
}

}  // namespace
}  // namespace knotlight
