#include "stability/heat_map.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/not_finite.h"

namespace knotlight {
namespace {

constexpr double infinite = infinity;

TEST(HeatMap, ShowsEveryNumberShortly) {
  const HeatMap map{"a < b",         "x",        "y",
                    {"1", "2", "3"}, {"p", "q"}, {1.23e-5, 0.123, nan, infinite, 4.4e12, 120.0}};
  const std::string svg = heat_maps_svg({map}, 1, {1e-6, 1.0, "error"});
  for (const char* text : {">1e-5<", ">0.12<", "><", ">∞<", ">4e12<", ">120<", "a &lt; b"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(HeatMap, ColoursFollowTheLogarithmAndStopAtTheEnds) {
  const HeatMap map{"", "", "", {"1", "2", "3", "4"}, {"p"}, {1e-9, 1e-8, 10.0, 1e9}};
  const std::string svg = heat_maps_svg({map}, 1, {1e-6, 1.0, ""});
  const auto fill_of = [&](const std::string& number) {
    const auto text = svg.find(">" + number + "<");
    const auto rect = svg.rfind("fill=\"rgb", text);
    return svg.substr(rect, svg.find(')', rect) - rect);
  };
  EXPECT_EQ(fill_of("1e-9"), fill_of("1e-8"));
  EXPECT_EQ(fill_of("1e9"), fill_of("10"));
  EXPECT_NE(fill_of("1e-8"), fill_of("10"));
}

TEST(HeatMap, RefusesAMapWithHoles) {
  const HeatMap map{"", "", "", {"1", "2"}, {"p"}, {1.0}};
  EXPECT_THROW(heat_maps_svg({map}, 1, {}), std::runtime_error);
}

}  // namespace
}  // namespace knotlight
