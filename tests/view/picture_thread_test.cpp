#include "view/picture_thread.h"

#include <gtest/gtest.h>

#include <vector>

#include "view/view_scenes.h"

namespace knotlight {
namespace {

// Collects what a thread shows.
class Spectator {
 public:
  void note() {
    const std::lock_guard lock(mutex_);
    ++frames_;
    changed_.notify_all();
  }
  void wait_for(const PictureThread& thread, int stride, int passes) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] {
      const auto frame = thread.frame();
      return frame && frame->stride == stride && frame->passes == passes;
    });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int frames_ = 0;
};

std::shared_ptr<const SolvedView> solved_ball() {
  RunContext run({}, false);
  FactorCache factors;
  return solve_view(test::ball(), Quality::full, run, factors);
}

TEST(StrideWithin, FinestThatIsFastEnough) {
  EXPECT_EQ(stride_within(1.0, 0.0, 100, 100), 1);
  EXPECT_EQ(stride_within(1.0, 1e-4, 100, 100), 1);
  EXPECT_EQ(stride_within(1.0, 1.01e-4, 100, 100), 2);
  EXPECT_EQ(stride_within(1.0, 5e-4, 100, 100), 3);
  EXPECT_EQ(stride_within(1.0, 1.0, 100, 100), 16);
}

// The picture on the screen is the mean of so many passes, the same bits whatever came before and
// however many threads made it.
TEST(PictureThread, RefinesToTheSameBits) {
  const auto view = solved_ball();
  const Camera camera = view->prepared->scene.camera;
  std::vector<Image> pictures;
  for (const int threads : {1, 3}) {
    Spectator spectator;
    PictureThread thread(5, threads, [&] { spectator.note(); });
    Camera other = camera;
    other.from = Vec3(4, -3, 1);
    thread.show({view, other, nullptr, 100, 0});
    thread.show({view, camera, nullptr, 6, 0});
    spectator.wait_for(thread, 1, 6);
    pictures.push_back(thread.frame()->image);
  }
  Accumulation expected(camera, 5);
  for (int pass = 0; pass < 6; ++pass)
    expected.add_pass(
        [&](const Ray& ray, Rng& rng) { return view->look.shading->radiance(ray, rng); },
        Workers(1));
  for (const Image& picture : pictures)
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      ASSERT_TRUE((picture.pixels[i] == expected.mean().pixels[i]).all()) << i;
}

TEST(PictureThread, LayersAreExact) {
  const auto view = solved_ball();
  const Camera camera = view->prepared->scene.camera;
  Spectator spectator;
  PictureThread thread(5, 2, [&] { spectator.note(); });
  const auto layer_at_middle = [&](const ViewLayer& layer) {
    thread.show({view, camera, &layer, 6, 1});
    while (!thread.frame() || thread.frame()->wish.layer != &layer)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Image& image = thread.frame()->image;
    EXPECT_TRUE(image.at(0, 0).isNaN().all());
    return Spectrum(image.at(16, 12));
  };
  for (const ViewLayer& layer : view_layers()) {
    const Spectrum value = layer_at_middle(layer);
    if (layer.name == std::string("object")) {
      EXPECT_EQ(value[0], 0.0);
    } else if (layer.name == std::string("depth")) {
      // The eye is sqrt(26) from the centre of the ball of radius 1; the pixel's middle is within
      // 0.1 of the axis.
      EXPECT_NEAR(value[0], std::sqrt(26.0) - 1.0, 0.01);
    } else if (layer.name == std::string("normal")) {
      EXPECT_NEAR(value.matrix().norm(), 1.0, 1e-9);
      EXPECT_LT(value[1], -0.9);
    } else if (layer.name == std::string("mean intensity U_d")) {
      EXPECT_GT(value[0], 0.0);
      EXPECT_EQ(value[0], value[2]);
    }
  }
}

}  // namespace
}  // namespace knotlight
