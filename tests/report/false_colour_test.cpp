#include "report/false_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/not_finite.h"

namespace knotlight {
namespace {

double luminance(const Spectrum& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

TEST(FalseColour, SequentialMapGrowsBrighter) {
  double last = -1.0;
  for (int i = 0; i <= 200; ++i) {
    const double now = luminance(map_colour(ColourMap::sequential, i / 200.0));
    EXPECT_GT(now, last) << i;
    last = now;
  }
}

TEST(FalseColour, DivergingMapIsWhiteAtZeroAndTellsSigns) {
  EXPECT_TRUE((map_colour(ColourMap::diverging, 0.5) == Spectrum::Ones()).all());
  const Spectrum low = map_colour(ColourMap::diverging, 0.2);
  const Spectrum high = map_colour(ColourMap::diverging, 0.8);
  EXPECT_GT(low[2], low[0]);
  EXPECT_GT(high[0], high[2]);
}

TEST(FalseColour, EndsHoldAndNothingIsGrey) {
  EXPECT_TRUE(
      (map_colour(ColourMap::sequential, 7.0) == map_colour(ColourMap::sequential, 1.0)).all());
  EXPECT_TRUE(
      (map_colour(ColourMap::sequential, -7.0) == map_colour(ColourMap::sequential, 0.0)).all());
  const Spectrum grey = map_colour(ColourMap::diverging, nan);
  EXPECT_EQ(grey[0], grey[1]);
  EXPECT_EQ(grey[1], grey[2]);
}

TEST(FalseColour, MapIsScaled) {
  const Image image = false_colour({3, 1, {-2.0, 0.0, 2.0}}, {ColourMap::diverging, -2.0, 2.0});
  EXPECT_TRUE((image.at(0, 0) == map_colour(ColourMap::diverging, 0.0)).all());
  EXPECT_TRUE((image.at(1, 0) == Spectrum::Ones()).all());
  EXPECT_TRUE((image.at(2, 0) == map_colour(ColourMap::diverging, 1.0)).all());
}

TEST(FalseColour, BarShowsTheEnds) {
  const std::string bar = colour_bar_svg({ColourMap::sequential, 0.0, 0.025}, "U_d < 1");
  EXPECT_NE(bar.find(">0.025<"), std::string::npos);
  EXPECT_NE(bar.find(">0.0125<"), std::string::npos);
  EXPECT_NE(bar.find("U_d &lt; 1"), std::string::npos);
}

TEST(FalseColour, QuantileOfSizeIgnoresSignAndHoles) {
  const ValueMap map{3, 2, {-4.0, 1.0, nan, 2.0, -3.0, 0.0}};
  EXPECT_EQ(quantile_of_size(map, 1.0), 4.0);
  EXPECT_EQ(quantile_of_size(map, 0.5), 2.0);
  EXPECT_EQ(quantile_of_size({1, 1, {nan}}, 1.0), 0.0);
}

}  // namespace
}  // namespace knotlight
