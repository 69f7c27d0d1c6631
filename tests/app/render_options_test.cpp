// What `render` can be asked for beside a picture, as a user asks for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/program.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using test::ProgramResult;
using test::read_file;
using test::run_program;
using test::ScratchFolder;

// Untrusted: two transport mean free paths across are too few for diffusion.
const char* const thin_ball = R"(units: mm
camera: {type: orthographic, from: [0, 0, 5], to: [0, 0, 0], up: [0, 1, 0], width: 2.4, resolution: [12, 10], samples: 1}
lights: [{type: point, position: [3, 0, 3], intensity: 18}]
materials: {wax: {type: translucent, sigma_a: 0.1, sigma_s: 1}}
objects: [{name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}]
solver: {photons: 12000, tolerance: 0.5}
)";

class RenderOptions : public testing::Test {
 protected:
  void SetUp() override { scratch_.write("scene.yaml", thin_ball); }

  ProgramResult render(const std::string& arguments) const {
    return run_program(KNOTLIGHT_PROGRAM, "render scene.yaml " + arguments, scratch_.folder());
  }
  void expect_bad_input(const std::string& arguments, const std::string& expected) const {
    const ProgramResult result = render(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  std::string bytes(const std::string& name) const { return read_file(scratch_.path(name)); }

  ScratchFolder scratch_;
};

TEST_F(RenderOptions, LayersGoIntoTheExr) {
  render("-o a.exr --layers depth,U_d");
  EXPECT_NE(bytes("a.exr").find("distance from the eye, mm"), std::string::npos);
  expect_bad_input("--layers detph", "did you mean 'depth'?");
  expect_bad_input("--layers ''", "--layers");
  expect_bad_input("-o a.png --layers depth", "a.png cannot hold layers, expected an .exr");
}

// Another picture of the same solution, with the same verdict on it.
TEST_F(RenderOptions, ASolutionIsKeptAndReused) {
  const ProgramResult fresh = render("-o fresh.exr --save-solution ball.solution");
  EXPECT_EQ(fresh.exit_code, 3);
  EXPECT_NE(fresh.err.find("diffusion does not hold"), std::string::npos) << fresh.err;
  const ProgramResult again = render("-o again.exr --solution ball.solution --json again.json");
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_EQ(again.err, fresh.err);
  EXPECT_TRUE(bytes("again.exr") == bytes("fresh.exr"));
  EXPECT_EQ(bytes("again.json").find("\"solve\""), std::string::npos);  // no such stage
  expect_bad_input("--solution ball.solution --set lights.0.intensity=17", "lights.0 differs");
  expect_bad_input("--solution ball.solution --save-solution b", "expected one of the two");
  expect_bad_input("--solution none.solution", "none.solution: no such file");
  expect_bad_input("--save-solution nowhere/ball.solution", "its folder does not exist");
}

}  // namespace
}  // namespace knotlight
