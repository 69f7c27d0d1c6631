// Every radial function with every solver, and both orders of the non-singular solutions, on one
// problem with a source whose solution is known: the thesis's own [V09 7.1] in a ball.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "bkm/bkm_cases.h"
#include "bkm/knots.h"
#include "bkm/shape_parameter.h"
#include "bkm/thesis_solver.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

constexpr double lambda = 1.5, k = 0.3;

struct Setting {
  BkmThesisProblem problem;
  Exact exact;
  Data data;
  Points checks;
};

Setting ball(int knots) {
  const Surface body = sphere(knots);
  const Points inner =
      grid_knots(body.points, 4.19, static_cast<std::size_t>(knots), [](const Vec3& x) {
        return x.norm() < 1.0;
      }).points;
  Setting s{problem(body, inner, lambda, k), thesis_case(lambda), {}, star_checks(sphere(211))};
  s.data = data_of(s.exact, s.problem);
  return s;
}

double relative_error(const Setting& s, const BkmThesisOptions& options) {
  const BkmThesisSolver solver(s.problem, options);
  if (!solver.ok()) return std::numeric_limits<double>::infinity();
  return max_error(solver.solve(s.data.f, s.data.g), s.exact, s.checks) /
         max_size(s.exact, s.checks);
}

// Largest errors allowed at 211 points none of which is a knot, for svd, qr, lu, GCV and L-curve:
// three times what was measured, so that a wrong term in any of them fails.
// Where the rank is so low that LU only amplifies rounding: anything finite or a refusal will do.
constexpr double unstable = std::numeric_limits<double>::infinity();
struct Row {
  const char* name;
  RadialKind kind;
  double c, exponent;
  int order;
  double allowed[5];
};
constexpr DenseMethod methods[] = {DenseMethod::svd, DenseMethod::qr, DenseMethod::lu,
                                   DenseMethod::tikhonov_gcv, DenseMethod::tikhonov_l_curve};
constexpr Row rows[] = {
    {"linear", RadialKind::linear, 1.0, 1.0, 1, {0.011, 0.011, 0.012, 0.012, 0.016}},
    {"cubic", RadialKind::cubic, 1.0, 1.0, 1, {0.0033, 0.0033, 0.0042, 0.0033, 0.019}},
    {"thin_plate", RadialKind::thin_plate, 1.0, 1.0, 1, {0.0084, 0.0084, 0.013, 0.0084, 0.3}},
    {"gaussian", RadialKind::gaussian, 1.0, 1.0, 1, {0.00075, 0.00069, 0.00087, 0.00072, 0.0051}},
    {"multiquadric", RadialKind::multiquadric, 1.0, 1.0, 1, {0.0048, 0.0045, 0.0045, 0.0045, 0.01}},
    {"inverse_multiquadric",
     RadialKind::inverse_multiquadric,
     1.0,
     3.0,
     1,
     {0.011, 0.011, 0.012, 0.011, 0.018}},
    {"compact_c0", RadialKind::compact_c0, 2.0, 1.0, 1, {0.021, 0.021, 0.039, 0.022, 0.2}},
    {"compact_c2", RadialKind::compact_c2, 2.0, 1.0, 1, {0.019, 0.019, 0.024, 0.021, 0.048}},
    {"compact_c4", RadialKind::compact_c4, 2.0, 1.0, 1, {0.012, 0.012, 0.016, 0.012, 0.048}},
    {"nonsingular 1", RadialKind::nonsingular, 1.0, 1.0, 1, {0.3, 0.3, unstable, 0.29, 0.28}},
    {"nonsingular 2",
     RadialKind::nonsingular,
     1.0,
     1.0,
     2,
     {0.0099, 0.013, unstable, 0.011, 0.017}},
    {"nonsingular 4",
     RadialKind::nonsingular,
     1.0,
     1.0,
     4,
     {0.00039, 0.00015, 0.0014, 0.00026, 0.00063}},
};

TEST(ThesisForms, EveryRadialFunctionWithEverySolver) {
  const Setting s = ball(200);
  for (const Row& row : rows) {
    std::string measured;
    for (int i = 0; i < 5; ++i) {
      BkmThesisOptions options{row.c, -1.0, row.kind, row.exponent, row.order};
      options.solver = methods[i];
      const double error = relative_error(s, options);
      EXPECT_LE(error, row.allowed[i]) << row.name << ", solver " << i;
      measured += fmt::format("{:.2g} ", error);
    }
    RecordProperty(row.name, measured);
  }
}

// A source of light outside the body, near enough that what it makes on the surface is beyond the
// rank of order 0. The source of the functions of higher order is taken away by dual reciprocity:
// what is left of it bounds what they gain.
TEST(ThesisForms, BoundaryBasisOfHigherOrder) {
  Setting s = ball(200);
  s.exact = point_source(lambda, Vec3(0.0, 0.0, 2.0));
  s.data = data_of(s.exact, s.problem);
  std::string measured;
  for (int order = 0; order <= max_order; ++order) {
    BkmThesisOptions options{1.0, -1.0};
    options.basis_order = order;
    const BkmThesisSolver solver(s.problem, options);
    const double error = relative_error(s, options);
    EXPECT_LT(error, 1e-1) << order;
    measured += fmt::format("{:.2g}/{} ", error, solver.homogeneous_rank());
  }
  RecordProperty("errors", measured);
}

// Without what dual reciprocity takes away the functions of order 1 would solve another equation:
// the field's own source must vanish where f does.
TEST(ThesisForms, HigherOrderLeavesNoSource) {
  Setting s = ball(200);
  s.exact = point_source(lambda, Vec3(0.0, 0.0, 3.0));
  s.data = data_of(s.exact, s.problem);
  BkmThesisOptions options{1.0, -1.0};
  options.basis_order = 1;
  const BkmField field = BkmThesisSolver(s.problem, options).solve(s.data.f, s.data.g);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < s.checks.cols(); ++i)
    largest = std::max(largest, std::abs(field.source(s.checks.col(i))));
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(largest, 1e-2 * max_size(s.exact, s.checks));  // three times what was measured
}

}  // namespace
}  // namespace knotlight
