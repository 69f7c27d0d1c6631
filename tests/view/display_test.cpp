#include "view/display.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/not_finite.h"

namespace knotlight {
namespace {

const ViewLayer& layer_named(const std::string& name) {
  for (const ViewLayer& layer : view_layers())
    if (layer.name == name) return layer;
  throw std::runtime_error("no layer " + name);
}

// The table of tones against the tone curve of pictures, from black to far beyond white.
TEST(ToneMappedBytes, FollowTheCurveOfPictures) {
  Image image{200, 1, {}};
  for (int i = 0; i < 200; ++i) image.pixels.push_back(Spectrum::Constant(i * i * 2e-4));
  const double exposure = 0.37;
  const ScreenImage screen = tone_mapped_bytes(image, exposure);
  const Image display = display_image(image, exposure);
  for (std::size_t i = 0; i < 200; ++i) {
    const std::uint32_t argb = screen.pixels[i];
    EXPECT_EQ(argb >> 24U, 255U);
    EXPECT_EQ((argb >> 16U) & 255U, argb & 255U);
    EXPECT_NEAR(static_cast<double>(argb & 255U), 255.0 * display.pixels[i][0], 1.0) << i;
  }
  EXPECT_EQ(screen.pixels[0] & 255U, 0U);
  EXPECT_EQ(screen.pixels[199] & 255U, 255U);
}

TEST(ToneMappedBytes, KeepChannelsApart) {
  const Image image{1, 1, {Spectrum(0.9, 0.2, 0.0)}};
  const std::uint32_t argb = tone_mapped_bytes(image, 1.0).pixels[0];
  EXPECT_GT((argb >> 16U) & 255U, (argb >> 8U) & 255U);
  EXPECT_GT((argb >> 8U) & 255U, argb & 255U);
}

// At the automatic exposure the screen shows what a .png file does.
TEST(ToneMappedBytes, AutomaticExposureIsThatOfFiles) {
  Image image{50, 1, {}};
  for (int i = 0; i < 50; ++i) image.pixels.push_back(Spectrum(0.1 * i, 0.07 * i, 0.2));
  const Image file = tone_map(image);
  const Image screen = display_image(image, automatic_exposure(image));
  for (std::size_t i = 0; i < 50; ++i) EXPECT_TRUE((file.pixels[i] == screen.pixels[i]).all());
}

TEST(LayerScale, FromZeroUnlessAllIsFarFromIt) {
  Image image{4, 1, {}};
  const auto scale_of = [&](double a, double b) {
    image.pixels = {Spectrum::Constant(a), Spectrum::Constant(nan), Spectrum::Constant(b),
                    Spectrum::Constant(b)};
    return layer_scale(image, 1);
  };
  EXPECT_EQ(scale_of(0.1, 2.0).low, 0.0);
  EXPECT_EQ(scale_of(0.1, 2.0).high, 2.0);
  EXPECT_EQ(scale_of(7.0, 9.0).low, 7.0);
  EXPECT_EQ(scale_of(7.0, 9.0).high, 9.0);
  EXPECT_EQ(scale_of(3.0, 3.0).low, 0.0);
  EXPECT_EQ(scale_of(nan, nan).high, 1.0);
}

TEST(LayerColours, ShowOneChannelAndMarkNothing) {
  const Image image{2, 1, {Spectrum(0.0, 1.0, 0.5), Spectrum::Constant(nan)}};
  const ViewLayer& layer = layer_named("mean intensity U_d");
  const Image low = layer_colours(image, layer, 0, {0.0, 1.0});
  const Image high = layer_colours(image, layer, 1, {0.0, 1.0});
  EXPECT_GT(high.pixels[0][1], 0.8);  // viridis ends in yellow
  EXPECT_LT(low.pixels[0][1], 0.1);   // and begins in violet
  EXPECT_TRUE((low.pixels[1] == high.pixels[1]).all());
  EXPECT_TRUE((low.pixels[1] == low.pixels[1][0]).all());  // grey
}

TEST(DescribeValue, NamesObjectsAndUnits) {
  Scene scene;
  scene.units = "mm";
  scene.objects.resize(2);
  scene.objects[1].name = "knot";
  EXPECT_EQ(describe_value(layer_named("object"), Spectrum::Ones(), 0, scene), "knot");
  EXPECT_EQ(describe_value(layer_named("mean intensity U_d"), Spectrum(1, 0.25, 3), 1, scene),
            "0.25 W/(mm^2 sr)");
  EXPECT_EQ(describe_value(layer_named("normal"), Spectrum(0, 0.6, -0.8), 0, scene),
            "(0.000, 0.600, -0.800)");
  EXPECT_EQ(describe_value(layer_named("depth"), Spectrum::Constant(nan), 0, scene), "");
}

}  // namespace
}  // namespace knotlight
