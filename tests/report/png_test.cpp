#include "report/png.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/scene_files.h"

namespace knotlight {
namespace {

// The decoder is OpenImageIO's: it knows nothing of our encoder.
Image decoded(const std::vector<unsigned char>& png) {
  // A new name each time: OpenImageIO remembers files by their names.
  static int files = 0;
  const test::ScratchFolder folder;
  return read_image(folder.write(std::to_string(++files) + ".png", {png.begin(), png.end()}));
}

double srgb_decode(double x) {  // IEC 61966-2-1
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

TEST(Png, AnotherDecoderReadsBackEveryPixel) {
  Image image{19, 7, {}};
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 19; ++x)
      image.pixels.emplace_back((13 * x + 29 * y) % 256 / 255.0, (255 - 11 * x) / 255.0,
                                (x == y ? 255 : 0) / 255.0);
  const Image back = decoded(png_bytes(image));
  ASSERT_EQ(back.width, 19);
  ASSERT_EQ(back.height, 7);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(back.pixels[i][c], srgb_decode(image.pixels[i][c]), 1e-6) << i << ' ' << c;
}

TEST(Png, ClipsToWhatCanBeShown) {
  const Image back = decoded(png_bytes({2, 1, {Spectrum(-1, 2, 0.5), Spectrum(1, 1, 1)}}));
  EXPECT_EQ(back.pixels[0][0], 0.0);
  EXPECT_EQ(back.pixels[0][1], 1.0);
}

TEST(Png, RefusesWhatIsNoPicture) {
  EXPECT_THROW(png_bytes({}), std::runtime_error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(png_bytes({1, 1, {Spectrum(0, nan, 0)}}), std::runtime_error);
}

}  // namespace
}  // namespace knotlight
