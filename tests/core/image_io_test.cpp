#include "core/image_io.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "core/errors.h"
#include "core/file_io.h"

namespace knotlight {
namespace {

namespace fs = std::filesystem;

class ImageIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() /
        ("knotlight_image_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
         testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

  fs::path folder_;
};

Image gradient() {
  Image image{5, 3, {}};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) image.pixels.push_back(Spectrum(0.25 * x, 0.5 * y, 2.0));
  return image;
}

// Values here are exact in float, so they come back exactly.
TEST_F(ImageIo, ExrKeepsValuesAndOrientation) {
  write_image(path("a.exr"), gradient(), {{"knotlight:units", "mm"}});
  const Image back = read_image(path("a.exr"));
  ASSERT_EQ(back.width, 5);
  ASSERT_EQ(back.height, 3);
  EXPECT_TRUE((back.at(4, 0) == Spectrum(1.0, 0.0, 2.0)).all());
  EXPECT_TRUE((back.at(0, 2) == Spectrum(0.0, 1.0, 2.0)).all());
}

TEST_F(ImageIo, PngIsToneMappedAndReadsBackWithinHalfALevel) {
  write_image(path("a.png"), gradient(), {});
  EXPECT_EQ(read_image(path("a.png")).width, 5);
}

TEST_F(ImageIo, ToneMapIsMonotoneAndInRange) {
  Image ramp{100, 1, {}};
  for (int x = 0; x < 100; ++x) ramp.pixels.push_back(Spectrum::Constant(0.01 * x * x));
  const Image display = tone_map(ramp);
  for (int x = 1; x < 100; ++x) {
    EXPECT_GT(display.at(x, 0)[0], display.at(x - 1, 0)[0]);
    EXPECT_LE(display.at(x, 0)[0], 1.0);
  }
  EXPECT_EQ(display.at(0, 0)[0], 0.0);
}

TEST_F(ImageIo, WrongExtensionIsBadInput) {
  EXPECT_THROW(check_image_extension("a.jpg"), InputError);
  EXPECT_THROW(check_image_extension("a"), InputError);
  EXPECT_NO_THROW(check_image_extension("a.png"));
}

TEST_F(ImageIo, NotFiniteIsNeverWritten) {
  Image image = gradient();
  image.at(2, 1)[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_image(path("a.exr"), image, {}), std::runtime_error);
  EXPECT_EQ(files(), 0U);
}

TEST_F(ImageIo, ReadingBadFiles) {
  EXPECT_THROW(read_image(path("none.exr")), InputError);
  std::ofstream(path("text.exr")) << "not a picture";
  EXPECT_THROW(read_image(path("text.exr")), InputError);
}

TEST_F(ImageIo, LayersComeBackAsTheyWere) {
  const std::vector<Layer> layers = {
      {"R", {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F}},
      {"G", {0.5F, 0.25F, 1e-30F, 1e30F, 0.0F, 1.0F}},
      {"B", {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F}},
      {"depth", {std::numeric_limits<float>::infinity(), -1.0F, 0.1F, 0.2F, 0.3F, 0.4F}},
      {"variance.R", {6.0F, 5.0F, 4.0F, 3.0F, 2.0F, 1.0F}}};
  write_layers(path("a.exr"), 3, 2, layers, {{"knotlight:units", "mm"}});
  const LayeredImage back = read_layers(path("a.exr"));
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.layers.size(), layers.size());
  for (const Layer& layer : layers) EXPECT_EQ(back.values(layer.channel), layer.values);
  EXPECT_THROW((void)back.values("variance.G"), InputError);
  // Programs that know nothing of layers see R, G, B.
  const Image colours = read_image(path("a.exr"));
  EXPECT_TRUE((colours.at(1, 1) == Spectrum(4.0, 0.0, 1.0)).all());
}

TEST_F(ImageIo, LayersThatCannotBeWritten) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_layers(path("a.exr"), 1, 1, {{"Y", {nan}}}, {}), std::runtime_error);
  EXPECT_THROW(write_layers(path("a.png"), 1, 1, {{"R", {1.0F}}}, {}), InputError);
  EXPECT_EQ(files(), 0U);
  EXPECT_THROW(read_layers(path("none.exr")), InputError);
  std::ofstream(path("text.exr")) << "not a picture";
  EXPECT_THROW(read_layers(path("text.exr")), InputError);
}

TEST_F(ImageIo, FailedWriteLeavesTheOldFileAndNoTrace) {
  write_text_file(path("a.txt"), "old");
  EXPECT_THROW(write_atomically(path("a.txt"),
                                [](const std::string& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw std::runtime_error("disk full");
                                }),
               std::runtime_error);
  std::ifstream in(path("a.txt"));
  std::string text;
  in >> text;
  EXPECT_EQ(text, "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ImageIo, WritingIntoAMissingFolderFails) {
  EXPECT_ANY_THROW(write_image(path("no/a.exr"), gradient(), {}));
  EXPECT_ANY_THROW(write_text_file(path("no/a.txt"), "x"));
}

}  // namespace
}  // namespace knotlight
