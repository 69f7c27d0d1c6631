#include "stability/methods.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

constexpr double albedo = 0.99;
constexpr double pinv_rule = -1.0;
const std::vector<double> exact_data{0.0};
const std::vector<double> both_data{0.0, 1e-3};

// All methods on one easy case: a source a radius away, lambda R = 1. What they reach was measured,
// half or less of these.
TEST(Methods, AgreeWithTheExactField) {
  const Body ball = unit_ball(), torus = thin_torus();
  for (const Body* body : {&ball, &torus}) {
    const BoundaryCase c = source_case(*body, 1.0, albedo, exact_data, 1);
    const std::size_t far = 1;
    EXPECT_LT(try_mfs(c, 200, 3.0)[far].error, 5e-3) << body->name;
    EXPECT_LT(try_lbkm(c, 1.01 * body->half_extent, 4)[far].error, 6e-2) << body->name;
    EXPECT_LT(try_grid(c, body->half_extent / 16.0)[far].error, 5e-2) << body->name;
  }
  const BoundaryCase c = source_case(ball, 1.0, albedo, exact_data, 1);
  EXPECT_LT(try_bkm(c, 200)[1].error, 2e-2);
  EXPECT_LT(try_thesis(c, 200, DenseMethod::svd, pinv_rule)[1].error, 2e-2);
}

TEST(Methods, OutcomesCountFieldsAndNoises) {
  const Body ball = unit_ball();
  const BoundaryCase c = source_case(ball, 1.0, albedo, both_data, 1);
  const std::vector<Outcome> outcomes = try_mfs(c, 100, 3.0);
  ASSERT_EQ(outcomes.size(), 4U);
  // Noise of 1e-3 costs about as much, and nothing where the error was larger before.
  EXPECT_NEAR(outcomes[3].error, outcomes[2].error, 1e-2);
  EXPECT_NE(outcomes[3].error, outcomes[2].error);
  EXPECT_DOUBLE_EQ(outcomes[0].rank, 100.0);
}

// The numerical rank of the non-singular solutions does not grow with their number.
TEST(Methods, TheThesisBasisHasARank) {
  const Body ball = unit_ball();
  const BoundaryCase c = source_case(ball, 1.0, albedo, exact_data, 1);
  const Outcome few = try_thesis(c, 150, DenseMethod::svd, pinv_rule)[0];
  const Outcome many = try_thesis(c, 300, DenseMethod::svd, pinv_rule)[0];
  EXPECT_LE(many.rank, few.rank + 1.0);
  EXPECT_LT(many.rank, 100.0);
  EXPECT_DOUBLE_EQ(many.unknowns, 300.0);
  EXPECT_GT(many.coefficient_size, 1e6);
}

TEST(Methods, LuAmplifiesNoiseThatACutRemoves) {
  const Body ball = unit_ball();
  BoundaryCase c = source_case(ball, 0.1, albedo, {1e-3}, 1);
  const Outcome lu = try_thesis(c, 300, DenseMethod::lu, pinv_rule)[1];
  const Outcome cut = try_thesis(c, 300, DenseMethod::svd, 1e-6)[1];
  EXPECT_GT(lu.error, 10.0 * cut.error);
}

// The field is smooth over a few widths of the layer here: dual reciprocity carries it, and not the
// thin one.
TEST(Methods, DualReciprocityCarriesThickLayersOnly) {
  const Body ball = unit_ball();
  const auto error = [&](double s) {
    BoundaryCase c = source_case(ball, 0.173 * s, albedo, exact_data, 1);
    c.fields = {decaying_layer(ball.foot.normal, s)};
    return try_dual_reciprocity(c, s, 100, RadialKind::gaussian, 8.0)[0].error;
  };
  EXPECT_LT(error(2.0), 0.02);
  EXPECT_GT(error(30.0), 0.1);
}

}  // namespace
}  // namespace knotlight
