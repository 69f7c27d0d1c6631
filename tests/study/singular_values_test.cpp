#include "study/singular_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/experiments.h"
#include "study/lit_body.h"

namespace knotlight {
namespace {

// (L + 1)^2 whatever the number of knots, as tests/bkm/rank_test.cpp has it for another pair.
TEST(BallRank, IsASquareWhateverTheKnots) {
  const double k = 2.0 / 15.0;
  for (const int count : {300, 500}) {
    EXPECT_EQ(ball_rank(count, std::sqrt(0.003) * 5.0, k), 36);
    EXPECT_EQ(ball_rank(count, std::sqrt(0.3) * 5.0, k), 144);
  }
}

// Every row of [V09 table 7.1]: 10, 11, 53 and 10 of 1296.
TEST(SingularValues, AreTheThesis) {
  RunOptions options;
  options.threads = 1;
  RunContext run(options, false);
  LitBodies bodies(false, run);
  StudyBench bench{{}, run, bodies};
  const StudyTable table = singular_values_study().run(bench).tables[0];
  ASSERT_GE(table.rows.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto number = [&](std::size_t column) { return std::get<double>(table.rows[i][column]); };
    EXPECT_EQ(number(3), number(2)) << i;
    // Its tolerance for the inverse multiquadric belongs to another size of the function; with
    // c = 10 not all entries are equal any more.
    if (i < 2) {
      EXPECT_NEAR(number(5) / number(4), 1.0, 1e-3);
    }
    if (i == 2) {
      EXPECT_NEAR(number(5) / number(4), 1.0, 0.03);
    }
  }
}

}  // namespace
}  // namespace knotlight
