#include "bkm/shape_parameter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bkm/bkm_cases.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

constexpr double lambda = 1.0;

double f(const Vec3& x) {
  return std::sin(2.0 * x.x() + 0.5) * std::cos(x.y()) + x.z();
}

// rms of f~ - f at points that are not knots.
double error_between(const Points& at, const Eigen::VectorXd& data, const RadialFunction& w) {
  const Points between = 0.93 * star_checks(sphere(251));
  Eigen::VectorXd e = source_matrix(between, at, w) * DenseSolver(source_matrix(at, w)).solve(data);
  for (Eigen::Index i = 0; i < e.size(); ++i) e(i) -= f(between.col(i));
  return std::sqrt(e.squaredNorm() / static_cast<double>(e.size()));
}

// Exact data, and data with 1 % of noise, as photons leave it.
TEST(ShapeParameter, LeaveOneOutIsNearTheBestOfAScan) {
  constexpr Eigen::Index count = 300;
  const Points at = star_checks(sphere(count));
  const double spacing = std::sqrt(4.0 * std::numbers::pi / static_cast<double>(count));
  for (const RadialKind kind : {RadialKind::gaussian, RadialKind::multiquadric,
                                RadialKind::inverse_multiquadric, RadialKind::compact_c4})
    for (const double noise : {0.0, 0.01}) {
      Eigen::VectorXd data(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        Rng rng(8, Stream::tests, static_cast<std::uint64_t>(i));
        data(i) = f(at.col(i)) + noise * std::sqrt(12.0) * (rng.uniform() - 0.5);
      }
      RadialFunction w{kind, 1.0, 1.0, 1, lambda, 2.0};
      const ShapeChoice chosen = leave_one_out_width(at, data, w, spacing, {}, {});
      double best = std::numeric_limits<double>::infinity();
      for (double c = spacing; c <= 16.001 * spacing; c *= std::exp2(0.25)) {
        w.c = c;
        best = std::min(best, error_between(at, data, w));
      }
      w.c = chosen.c;
      EXPECT_LT(error_between(at, data, w), 2.0 * best)
          << static_cast<int>(kind) << " noise " << noise << " c " << chosen.c / spacing;
      EXPECT_LE(chosen.factorisations, 9);
    }
}

TEST(ShapeParameter, DataThatAreNotFiniteGiveTheDefault) {
  const Points at = star_checks(sphere(40));
  Eigen::VectorXd data = Eigen::VectorXd::Ones(40);
  data(3) = std::numeric_limits<double>::quiet_NaN();
  const ShapeChoice chosen = leave_one_out_width(at, data, {}, 0.5, {}, {});
  EXPECT_EQ(chosen.c, 0.5 * default_shape_parameter());
  EXPECT_TRUE(std::isnan(chosen.error));
}

}  // namespace
}  // namespace knotlight
