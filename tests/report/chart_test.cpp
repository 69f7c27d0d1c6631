#include "report/chart.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <stdexcept>

#include "core/not_finite.h"

namespace knotlight {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

Chart two_lines() {
  return {"It's a `chart` of a_b",
          "x {mm}",
          "y < 1",
          false,
          false,
          {{"first_one", {1, 2, 3}, {1, 4, 9}, {0.5, 0.5, 0.5}}, {"second", {1, 3}, {2, 2}, {}}}};
}

TEST(Chart, HoldsWhatItWasGiven) {
  const std::string svg = chart_svg(two_lines());
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  // Names stand as they are, none of them read as a command or as an index.
  for (const char* text : {"`chart` of a_b", "x {mm}", "y &lt; 1", "first_one", "second"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Chart, SameBytesEveryTime) {
  EXPECT_EQ(chart_svg(two_lines()), chart_svg(two_lines()));
}

TEST(Chart, ValuesThatCannotBeDrawnLeaveGaps) {
  Chart chart{"t", "x", "y", true, true, {{"s", {0, 1, 10, 100, 1000}, {1, 1, nan, -2, 5}, {}}}};
  const std::string svg = chart_svg(chart);
  // Of five points two can be drawn: (1, 1) and (1000, 5). Circles (gpPt6): two and one in the key.
  EXPECT_EQ(count(svg, "<use xlink:href='#gpPt6'"), 3U);
}

TEST(Chart, RefusesWhatItCannotDraw) {
  const Chart nothing{"t", "x", "y", false, true, {{"s", {1, 2}, {0, -1}, {}}}};
  EXPECT_THROW(chart_svg(nothing), std::runtime_error);
  const Chart crooked{"t", "x", "y", false, false, {{"s", {1, 2}, {1}, {}}}};
  EXPECT_THROW(chart_svg(crooked), std::runtime_error);
}

TEST(Chart, SaysThatGnuplotIsMissing) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  std::string message;
  try {
    chart_svg(two_lines());
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("gnuplot-nox"), std::string::npos) << message;
}

}  // namespace
}  // namespace knotlight
