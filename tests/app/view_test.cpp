// The viewer's window, driven as by a hand, on a screen that is a file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/image_io.h"
#include "scene/scene_reader.h"
#include "support/program.h"
#include "support/scene_files.h"
#include "support/virtual_screen.h"

namespace knotlight {
namespace {

using test::ScratchFolder;
using test::Screenshot;
using test::VirtualScreen;

const std::string knot = std::string(KNOTLIGHT_ROOT) + "/scenes/knot.yaml";

// Without a window manager the window stands in the middle of the screen; the picture of knot.yaml
// fills all of it but the panel.
constexpr int screen_width = 1340, screen_height = 720, picture_width = 960;
// Rows of the panel, pixels from the top.
constexpr int exposure_row = 131, scene_button_row = 255, first_center_row = 342;
// Mean grey levels of 255 by which pictures differ that show something else; frames of one picture
// with different noise are about 2 apart.
constexpr double clear_difference = 6.0;
constexpr double patience = 60.0;  // seconds, on a busy machine

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

// In steps, as a hand moves: (x, y) are pixels of the window.
void drag(const VirtualScreen& screen, int x, int y, int dx, int dy) {
  constexpr int steps = 10;
  std::string words = fmt::format("mousemove {} {} sleep 0.2 mousedown 1", x, y);
  for (int i = 1; i <= steps; ++i)
    words += fmt::format(" sleep 0.03 mousemove {} {}", x + dx * i / steps, y + dy * i / steps);
  screen.hand(words + " sleep 0.5 mouseup 1");
}

TEST(ViewCommand, AHandOnTheWindow) {
  if (!VirtualScreen::is_available()) GTEST_SKIP() << "needs the Debian packages xvfb and xdotool";
  const ScratchFolder folder;
  const VirtualScreen screen(screen_width, screen_height, folder.folder());
  ASSERT_FALSE(screen.display().empty()) << "Xvfb did not start";
  test::Child viewer({"/usr/bin/env", "-C", folder.folder().string(), KNOTLIGHT_PROGRAM, "view",
                      knot, "--set", "solver.photons=20000", "--set", "solver.tolerance=0.05"},
                     {screen.display(), "SDL_VIDEODRIVER=x11"}, folder.folder() / "words");

  const Screenshot dark = screen.look();
  ASSERT_TRUE(eventually([&] { return screen.look().mean(picture_width) > 60.0; }))
      << "no picture: " << test::read_file(folder.folder() / "words");
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // the exposure settles

  const Screenshot before = screen.look();
  drag(screen, 300, 300, 250, 40);
  EXPECT_TRUE(eventually([&] {
    return screen.look().difference(before, picture_width) > clear_difference;
  })) << "dragging does not turn the picture";

  const Screenshot turned = screen.look();
  drag(screen, picture_width + 137, exposure_row, 25, 0);
  EXPECT_TRUE(eventually([&] {
    return screen.look().mean(picture_width) > turned.mean(picture_width) + clear_difference;
  })) << "the exposure slider does not make it brighter";

  screen.hand("mousemove 300 300 sleep 0.1 key space");
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  const Screenshot lit = screen.look();
  drag(screen, picture_width + 50, first_center_row, -150, 0);
  EXPECT_TRUE(eventually([&] {
    return screen.look().difference(lit, picture_width) > clear_difference;
  })) << "moving a light does not change the picture";

  screen.hand(
      fmt::format("mousemove {} {} sleep 0.2 click 1", picture_width + 320, scene_button_row));
  EXPECT_TRUE(eventually([&] {
    return std::filesystem::exists(folder.folder() / "knot-view.yaml");
  })) << "no scene was saved";
  const Scene saved = read_scene(folder.path("knot-view.yaml"));
  const Scene original = read_scene(knot);
  EXPECT_LT(std::get<AreaLight>(saved.lights[0]).center.x(),
            std::get<AreaLight>(original.lights[0]).center.x() - 1.0);
  EXPECT_EQ(saved.solver.photons, 20000U);

  screen.hand("mousemove 300 300 sleep 0.2 key s");
  EXPECT_TRUE(eventually([&] { return std::filesystem::exists(folder.folder() / "knot.png"); }))
      << "no picture was saved";
  const Image picture = read_image(folder.path("knot.exr"));
  EXPECT_EQ(picture.width, picture_width);
  EXPECT_EQ(picture.height, screen_height);

  screen.hand("key q");
  EXPECT_EQ(viewer.exit_code(patience), 0);
  EXPECT_EQ(test::read_file(folder.folder() / "words"), "");
}

TEST(ViewCommand, WithoutADisplayOneLine) {
  const ScratchFolder folder;
  const test::ProgramResult result =
      test::run_program("env",
                        "-u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER '" +
                            std::string(KNOTLIGHT_PROGRAM) + "' view '" + knot + "'",
                        folder.folder());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "error: cannot open a window: there is no display (neither DISPLAY nor WAYLAND_DISPLAY "
            "is set)\n");
  const test::ProgramResult refused =
      test::run_program("env",
                        "DISPLAY=:987 SDL_VIDEODRIVER=x11 '" + std::string(KNOTLIGHT_PROGRAM) +
                            "' view '" + knot + "'",
                        folder.folder());
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.err.find("error: cannot open a window: "), 0U);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1);
}

TEST(ViewCommand, BadScenesEndAsEverywhere) {
  const ScratchFolder folder;
  const test::ProgramResult result =
      test::run_program(KNOTLIGHT_PROGRAM, "view none.yaml", folder.folder());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err.find("none.yaml: cannot be opened"), 0U);
}

}  // namespace
}  // namespace knotlight
