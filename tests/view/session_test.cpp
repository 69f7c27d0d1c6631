#include "view/session.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "core/errors.h"
#include "core/image_io.h"
#include "scene/scene_reader.h"
#include "support/scene_files.h"
#include "view/view_scenes.h"

namespace knotlight {
namespace {

using test::ScratchFolder;

// Runs the session as a window does until a picture with so many samples of a view solved in full
// quality is there.
void run_until_refined(ViewSession& session, int passes) {
  for (int i = 0; i < 6000; ++i) {
    session.update();
    const auto frame = session.frame();
    if (session.status().activity == SolveThread::Activity::idle && frame &&
        frame->wish.view.get() == session.view() && session.view()->quality == Quality::full &&
        frame->stride == 1 && frame->passes >= passes)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  FAIL() << "not refined within a minute";
}

TEST(ViewSession, RefinesBeyondTheScenesSamples) {
  const ScratchFolder folder;
  ViewSession session(folder.write("ball.yaml", test::ball_scene), {}, [] {});
  EXPECT_EQ(session.most_passes(), 256);
  run_until_refined(session, 3);
  EXPECT_GT(session.exposure(), 0.0);
  const double automatic = session.exposure();
  session.exposure_stops = 2.0;
  EXPECT_NEAR(session.exposure(), 4.0 * automatic, 1e-9 * automatic);
  EXPECT_EQ(session.eye_inside(), "");
}

TEST(ViewSession, SavesPictureAndScene) {
  const ScratchFolder folder;
  ViewSession session(folder.write("ball.yaml", test::ball_scene), {}, [] {});
  EXPECT_THROW(session.save_picture(folder.path("early")), InputError);
  session.set_room(64, 64);
  Camera camera = session.camera();
  camera.from = Vec3(3, -4, 2);
  session.set_camera(camera);
  session.edit(Change::lights, [](Scene& scene) {
    std::get<PointLight>(scene.lights[0]).position = Vec3(-3, -2, 3);
  });
  TranslucentMaterial wax = *session.scene().objects[0].translucent();
  wax.sigma_a = Spectrum::Constant(0.4);
  session.edit_material(session.materials()[0], wax);
  run_until_refined(session, 1);

  session.save_picture(folder.path("seen"));
  const Image exr = read_image(folder.path("seen.exr"));
  EXPECT_EQ(exr.width, 64);
  EXPECT_EQ(exr.height, 48);
  EXPECT_GT(exr.at(32, 24)[0], 0.0);
  EXPECT_TRUE(std::filesystem::exists(folder.path("seen.png")));

  session.save_scene(folder.path("changed.yaml"));
  const Scene copy = read_scene(folder.path("changed.yaml"));
  EXPECT_EQ(copy.camera.from, Vec3(3, -4, 2));
  EXPECT_EQ(copy.camera.width_px, 32);
  EXPECT_EQ(std::get<PointLight>(copy.lights[0]).position, Vec3(-3, -2, 3));
  EXPECT_EQ(copy.objects[0].translucent()->sigma_a[0], 0.4);

  session.reset_camera();
  EXPECT_EQ(session.camera().from, Vec3(0, -5, 1));
}

TEST(ViewSession, MaterialsKnowTheirObjects) {
  const ScratchFolder folder;
  ViewSession session(
      folder.write("two.yaml",
                   test::replaced(test::ball_scene, "objects: [",
                                  "objects: [{name: other, sphere: {center: [3, 0, 0], radius: "
                                  "0.5}, material: wax}, ")),
      {}, [] {});
  ASSERT_EQ(session.materials().size(), 1U);
  EXPECT_EQ(session.materials()[0].name, "wax");
  EXPECT_EQ(session.materials()[0].objects, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ViewSession, ShowsLayersAndNoticesAnEyeInside) {
  const ScratchFolder folder;
  ViewSession session(folder.write("ball.yaml", test::ball_scene), {}, [] {});
  session.set_layer(&view_layers()[0]);
  run_until_refined(session, 1);
  EXPECT_EQ(session.frame()->wish.layer, &view_layers()[0]);
  session.save_picture(folder.path("layer"));
  EXPECT_EQ(read_image(folder.path("layer.exr")).at(0, 0)[0], 0.0);
  Camera camera = session.camera();
  camera.from = Vec3(0, -0.5, 0);
  session.set_camera(camera);
  EXPECT_EQ(session.eye_inside(), "ball");
}

TEST(ViewSession, RefusesWhatRenderRefuses) {
  const ScratchFolder folder;
  EXPECT_THROW(ViewSession(folder.path("none.yaml"), {}, [] {}), InputError);
  EXPECT_THROW(ViewSession(folder.write("bad.yaml", test::replaced(test::ball_scene, "sigma_a: 0.2",
                                                                   "sigma_a: -1")),
                           {}, [] {}),
               InputError);
  ViewSession session(folder.write("ball.yaml", test::ball_scene), {}, [] {});
  EXPECT_THROW(session.save_scene(folder.path("scene.txt")), InputError);
  EXPECT_THROW(session.save_scene(folder.path("nowhere/scene.yaml")), InputError);
}

}  // namespace
}  // namespace knotlight
