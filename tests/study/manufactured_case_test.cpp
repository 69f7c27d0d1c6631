#include "study/manufactured_case.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

constexpr double of_the_thesis = 4.8332e-5;  // [V09 ch. 7]
constexpr double width = 2.0;

double by_the_thesis(int n, DistancePrecision precision) {
  const ManufacturedProblem p = manufactured_problem(n, n - 1);
  BkmThesisOptions options;
  options.c = width;
  options.precision = precision;
  return manufactured_error(
      BkmThesisSolver(p.problem, options).solve(p.f, p.g).values(manufactured_checks()));
}

// Source and gradient against differences, whose error falls four-fold with half the step.
TEST(Manufactured, SourceAndGradientBelongToTheSolution) {
  const double lambda = manufactured_lambda();
  for (const Vec3& x : {Vec3(1.2, 0.7, 1.7), Vec3(0.4, 1.9, 0.2)}) {
    const auto source_error = [&](double h) {
      double laplacian = -6.0 * manufactured_u(x);
      for (int axis = 0; axis < 3; ++axis)
        laplacian +=
            manufactured_u(x + h * Vec3::Unit(axis)) + manufactured_u(x - h * Vec3::Unit(axis));
      return laplacian / (h * h) - lambda * lambda * manufactured_u(x) - manufactured_source(x);
    };
    EXPECT_NEAR(source_error(2e-2) / source_error(1e-2), 4.0, 0.1);
    const double h = 1e-5;  // balances the rounding eps/h and the truncation h^2 at 1e-10
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(
          (manufactured_u(x + h * Vec3::Unit(axis)) - manufactured_u(x - h * Vec3::Unit(axis))) /
              (2.0 * h),
          manufactured_gradient(x)[axis], 1e-8);
  }
}

TEST(Manufactured, TheMethodMeetsTheThesisAndTheBetterOneBeatsItTenfold) {
  EXPECT_LT(by_the_thesis(8, DistancePrecision::double_precision), of_the_thesis);
  EXPECT_LT(manufactured_error(manufactured_better(manufactured_problem(8, 7), 8,
                                                   DistancePrecision::double_precision)),
            0.1 * of_the_thesis);
}

// [V09 fig. 7.3]: float has a floor far above that of double; the better conditioned way loses
// less.
TEST(Manufactured, FloatHasItsFloor) {
  const double in_double = by_the_thesis(6, DistancePrecision::double_precision);
  const double in_float = by_the_thesis(6, DistancePrecision::single_precision);
  EXPECT_GT(in_float, 100.0 * in_double);
  const ManufacturedProblem p = manufactured_problem(6, 5);
  EXPECT_LT(manufactured_error(manufactured_better(p, 6, DistancePrecision::single_precision)),
            0.2 * in_float);
}

}  // namespace
}  // namespace knotlight
