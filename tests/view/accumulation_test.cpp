#include "view/accumulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

Camera small_camera() {
  Camera camera;
  camera.type = Camera::Type::orthographic;
  camera.from = Vec3(0, 0, 5);
  camera.to = Vec3::Zero();
  camera.up = Vec3::UnitY();
  camera.width_px = 40;
  camera.height_px = 30;
  camera.width = 4.0;
  return camera;
}

Spectrum noisy(const Ray& ray, Rng& rng) {
  return Spectrum(ray.origin.x(), rng.uniform(), rng.uniform() * ray.origin.y());
}

TEST(Accumulation, SameBitsForAnyNumberOfThreads) {
  Accumulation one(small_camera(), 7), three(small_camera(), 7);
  for (int pass = 0; pass < 5; ++pass) {
    one.add_pass(noisy, Workers(1));
    three.add_pass(noisy, Workers(3));
  }
  const Image a = one.mean(), b = three.mean();
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    ASSERT_TRUE((a.pixels[i] == b.pixels[i]).all()) << i;
}

// The first pass goes through the middles of pixels; all of them together are even over a pixel:
// the mean of a linear function is its value there, up to the discrepancy of 256 points of the R2
// sequence (about 1/256 of a pixel, 0.1 wide).
TEST(Accumulation, SamplesFillPixelsEvenly) {
  const auto position = [](const Ray& ray, Rng&) {
    return Spectrum(ray.origin.x(), ray.origin.y(), 1.0);
  };
  Accumulation picture(small_camera(), 1);
  picture.add_pass(position, Workers(2));
  const Image first = picture.mean();
  EXPECT_NEAR(first.at(0, 0)[0], -2.0 + 0.05, 1e-12);
  EXPECT_NEAR(first.at(0, 0)[1], 1.5 - 0.05, 1e-12);
  for (int pass = 1; pass < 256; ++pass) picture.add_pass(position, Workers(2));
  EXPECT_EQ(picture.passes(), 256);
  const Image mean = picture.mean();
  for (const auto& [x, y] : {std::pair{0, 0}, {39, 29}, {17, 4}}) {
    EXPECT_NEAR(mean.at(x, y)[0], -2.0 + 0.1 * (x + 0.5), 1e-3);
    EXPECT_NEAR(mean.at(x, y)[1], 1.5 - 0.1 * (y + 0.5), 1e-3);
    EXPECT_NEAR(mean.at(x, y)[2], 1.0, 1e-12);
  }
}

// Uniform numbers: 1200 pixels of 16 passes have a mean of 1/2 with a standard error of
// sqrt(1/12 / 19200) = 0.0021; 5 of them are passed once in 1.7e6 times. Passes that repeated each
// other's numbers would have a spread between pixels 4 times as large as 16 independent ones.
TEST(Accumulation, PassesAreIndependent) {
  const auto random = [](const Ray&, Rng& rng) {
    return Spectrum(Spectrum::Constant(rng.uniform()));
  };
  Accumulation picture(small_camera(), 3);
  for (int pass = 0; pass < 16; ++pass) picture.add_pass(random, Workers(2));
  double sum = 0.0, squares = 0.0;
  const Image mean = picture.mean();
  for (const Spectrum& pixel : mean.pixels) {
    sum += pixel[0];
    squares += pixel[0] * pixel[0];
  }
  const auto n = static_cast<double>(mean.pixels.size());
  EXPECT_NEAR(sum / n, 0.5, 5 * 0.0021);
  const double variance = squares / n - sum / n * sum / n;
  // 1/192, with a relative standard error of sqrt(2 / 1200) = 0.041.
  EXPECT_NEAR(variance * 192.0, 1.0, 5 * 0.041);
}

TEST(Accumulation, StopsWhenCancelled) {
  std::atomic<bool> cancelled{true};
  Accumulation picture(small_camera(), 1);
  EXPECT_THROW(picture.add_pass(noisy, Workers(2, &cancelled)), Cancelled);
}

TEST(FittedCamera, KeepsTheShapeWithinTheRoom) {
  Camera camera = small_camera();  // 4 : 3
  EXPECT_EQ(fitted(camera, 800, 300).width_px, 400);
  EXPECT_EQ(fitted(camera, 800, 300).height_px, 300);
  EXPECT_EQ(fitted(camera, 100, 300).width_px, 100);
  EXPECT_EQ(fitted(camera, 100, 300).height_px, 75);
  EXPECT_EQ(fitted(camera, 1, 1).height_px, 1);
  EXPECT_EQ(coarse(camera, 4).width_px, 10);
  EXPECT_EQ(coarse(camera, 64).height_px, 1);
}

}  // namespace
}  // namespace knotlight
