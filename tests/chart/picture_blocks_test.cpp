#include "chart/picture_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"

namespace knotlight {
namespace {

// A box that fills the middle 32 x 32 of 64 x 64 pixels: 4 x 4 blocks.
PreparedScene box_in_the_middle() {
  Scene scene;
  scene.camera.type = Camera::Type::orthographic;
  scene.camera.from = {0, 0, 5};
  scene.camera.up = Vec3::UnitY();
  scene.camera.width = 2.0;
  scene.camera.width_px = scene.camera.height_px = 64;
  TranslucentMaterial wax;
  wax.sigma_s = Spectrum::Ones();
  scene.objects = {{"box", box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), wax}};
  return prepare_scene(std::move(scene));
}

TEST(PictureBlocks, AreTheOnesThatLieOnTheObject) {
  const PreparedScene prepared = box_in_the_middle();
  const PictureBlocks blocks(prepared);
  Image image{64, 64, std::vector<Spectrum>(64 * 64, Spectrum::Constant(7.0))};
  // Column x shines as x; a block's mean is that of its columns.
  for (int y = 16; y < 48; ++y)
    for (int x = 16; x < 48; ++x) image.at(x, y) = Spectrum::Constant(x);
  const Eigen::VectorXd means = blocks.means(image);
  ASSERT_EQ(means.size(), 16);
  for (Eigen::Index i = 0; i < 16; ++i)
    EXPECT_NEAR(means[i], 19.5 + 8.0 * static_cast<double>(i % 4), 1e-12);
}

TEST(PictureBlocks, ErrorIsRelativeToTheMean) {
  const Eigen::VectorXd b = Eigen::VectorXd::Constant(9, 2.0);
  EXPECT_NEAR(block_error(1.1 * b, b), 0.1, 1e-12);
  // Root mean square .2 of which .12 are noise: sqrt(.2^2 - .12^2) / 2 = .08.
  EXPECT_NEAR(block_error(b.array() + 0.2, b, Eigen::VectorXd::Constant(9, 0.12)), 0.08, 1e-12);
  EXPECT_EQ(block_error(b, b, Eigen::VectorXd::Constant(9, 0.12)), 0.0);
  EXPECT_TRUE(std::isnan(block_error(b * std::nan(""), b)));
}

// Noise of known size in every pixel: a block's standard error is that over 8.
TEST(PictureBlocks, KnowTheNoiseOfPathTracing) {
  const PreparedScene prepared = box_in_the_middle();
  const PictureBlocks blocks(prepared);
  PathFilm film(prepared.scene.camera);
  film.samples = 400;
  for (std::size_t pixel = 0; pixel < film.sum.size(); ++pixel) {
    Rng rng(1, Stream::pixels, pixel);
    for (std::uint64_t s = 0; s < film.samples; ++s) {
      const double value = rng.uniform();  // mean 1/2, variance 1/12
      film.sum[pixel] += value;
      film.sum_of_squares[pixel] += value * value;
    }
  }
  const PictureBlocks::Judged judged = blocks.means(film);
  const double error = std::sqrt(1.0 / 12.0 / 400.0) / 8.0;
  for (Eigen::Index i = 0; i < judged.means.size(); ++i) {
    // Six standard errors: false alarms 3e-8 over the 16 blocks.
    EXPECT_NEAR(judged.means[i], 0.5, 6.0 * error);
    // A sample variance of 400 x 64 values is known to 0.6 %; its root to 0.3 %.
    EXPECT_NEAR(judged.errors[i] / error, 1.0, 0.02);
  }
}

}  // namespace
}  // namespace knotlight
