#include "chart/front.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

Measurement measured(const std::string& line, double seconds, double error,
                     const std::string& failed = "") {
  Measurement m;
  m.line = line;
  m.setting = std::to_string(seconds);
  m.failed = failed;
  m.picture_seconds = seconds;
  m.picture.error = error;
  return m;
}

const std::vector<Measurement> some = {
    measured("grid", 1.0, 0.05),       measured("grid", 4.0, 0.01),
    measured("lbkm", 2.0, 0.06),       measured("bkm", 0.5, 0.001, "exit 3"),
    measured(dipole_line, 0.1, 0.2),   measured(path_tracing_line, 10.0, 0.04),
    measured(default_line, 3.0, 0.05), measured("mfs", 4.0, 0.02)};

TEST(Front, HoldsWhatNothingTrustedBeats) {
  const std::vector<Measurement> front = pareto_front(some, Quantity::picture);
  ASSERT_EQ(front.size(), 3U);
  EXPECT_EQ(front[0].line, dipole_line);
  EXPECT_EQ(front[1].line, "grid");
  EXPECT_EQ(front[1].picture.error, 0.05);
  EXPECT_EQ(front[2].picture.error, 0.01);
  EXPECT_TRUE(pareto_front(some, Quantity::field).empty());
}

TEST(Front, CheapestIsOursAndTrusted) {
  EXPECT_EQ(cheapest(some, Quantity::picture, 0.3)->picture_seconds, 1.0);
  EXPECT_EQ(cheapest(some, Quantity::picture, 0.02)->picture_seconds, 4.0);
  EXPECT_FALSE(cheapest(some, Quantity::picture, 0.005));
}

TEST(Front, OtherProgramsAreRivals) {
  std::vector<Measurement> all = some;
  all.push_back(measured(finite_elements_line, 0.01, 0.001));
  EXPECT_EQ(pareto_front(all, Quantity::picture).front().line, finite_elements_line);
  EXPECT_EQ(cheapest(all, Quantity::picture, 0.02)->picture_seconds, 4.0);
  EXPECT_EQ(seconds_for(all, finite_elements_line, Quantity::picture, 0.02)->seconds, 0.01);
}

TEST(Front, PathTracingIsExtrapolatedByItsLaw) {
  const auto half = seconds_for(some, path_tracing_line, Quantity::picture, 0.02);
  ASSERT_TRUE(half);
  EXPECT_TRUE(half->extrapolated);
  EXPECT_DOUBLE_EQ(half->seconds, 40.0);
  const auto known = seconds_for(some, path_tracing_line, Quantity::picture, 0.04);
  EXPECT_FALSE(known->extrapolated);
  EXPECT_FALSE(seconds_for(some, "lbkm", Quantity::picture, 0.02));
  EXPECT_FALSE(seconds_for(some, "bkm", Quantity::picture, 0.02));
}

TEST(Front, LeastErrorIsOfTrustedOnes) {
  EXPECT_EQ(least_error(some, "grid", Quantity::picture), 0.01);
  EXPECT_EQ(least_error(some, "bkm", Quantity::picture), std::numeric_limits<double>::infinity());
}

TEST(Front, ToleranceIsHeldAgainstTheCheapest) {
  const std::vector<ToleranceCheck> checks = check_tolerance(some, Quantity::picture);
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks[0].best.line, "grid");
  EXPECT_DOUBLE_EQ(checks[0].ratio, 3.0);
}

}  // namespace
}  // namespace knotlight
