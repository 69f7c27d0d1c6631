#include "study/lit_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/not_finite.h"
#include "study/lit_line.h"

namespace knotlight {
namespace {

using std::numbers::pi;

TEST(ThesisMedium, HasTheLambdaOfTable71) {
  const Medium m = thesis_medium();
  // 1296^2 lambda^2 2^-52 = 2.357e-9 [V09 table 7.1], to its four digits.
  EXPECT_NEAR(1296.0 * 1296.0 * m.lambda() * m.lambda() * std::exp2(-52.0), 2.357e-9, 0.001e-9);
  EXPECT_NEAR(2.0 * m.sigma_tr(), 10.0, 0.01);  // mean free paths across
}

// The solid angle of a ball of radius 1 at the distance 3: 2 pi (1 - sqrt(8)/3).
TEST(LitBody, LampsPowerArrives) {
  const LitBody ball{LitShape::ball, thesis_medium()};
  const SurfaceSamples knots = ball_knots(200, false, 1);
  double power = 0.0;
  for (Eigen::Index i = 0; i < knots.positions.cols(); ++i)
    power += ball.irradiance({knots.positions.col(i), knots.normals.col(i)});
  power *= 4.0 * pi / static_cast<double>(knots.positions.cols());
  EXPECT_NEAR(power, 2.0 * pi * (1.0 - std::sqrt(8.0) / 3.0), 2e-4);  // midpoint rule, 200 rings
}

// Knots stand for equal areas: means of x.n are those of the divergence theorem, 3 V / S.
TEST(LitBody, KnotsAreSpreadByArea) {
  const auto mean = [](const SurfaceSamples& s) {
    return s.positions.cwiseProduct(s.normals).colwise().sum().mean();
  };
  EXPECT_EQ(cube_triangle_knots(6).positions.cols(), 432);
  EXPECT_EQ(cube_face_knots(8).positions.cols(), 384);
  EXPECT_EQ(ball_knots(22, true, 1).positions.cols(), 484);
  EXPECT_NEAR(mean(cube_triangle_knots(6)), 1.0, 1e-12);
  EXPECT_NEAR(mean(cube_face_knots(8)), 1.0, 1e-12);
  EXPECT_NEAR(mean(ball_knots(22, false, 1)), 1.0, 1e-12);
  const LitBody cube{LitShape::cube, thesis_medium()}, ball{LitShape::ball, thesis_medium()};
  for (Eigen::Index i = 0; i < 432; ++i) {
    EXPECT_NEAR(cube.depth(cube_triangle_knots(6).positions.col(i)), 0.0, 1e-12);
    EXPECT_NEAR(ball.depth(ball_knots(22, true, 1).positions.col(i)), 0.0, 1e-12);
  }
}

TEST(ThesisProblem, LampsStandOneMeanFreePathBelow) {
  const LitBody cube{LitShape::cube, thesis_medium()};
  ThesisSetup setup = usual_setup(cube, true, 1);
  setup.layers = {0.5, 1.5};
  const ThesisProblem p = thesis_problem(cube, setup);
  const Eigen::Index n = setup.knots.positions.cols();
  ASSERT_EQ(p.problem.interior_points.cols(), 3 * n);
  const double sigma_tr = cube.medium.sigma_tr();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 x = setup.knots.positions.col(i), inward = -setup.knots.normals.col(i);
    EXPECT_NEAR((p.problem.interior_points.col(i) - x).dot(inward), 1.0 / sigma_tr, 1e-12);
    EXPECT_NEAR((p.problem.interior_points.col(2 * n + i) - x).dot(inward), 1.5 / sigma_tr, 1e-12);
    const double E = cube.irradiance({x, -inward});
    EXPECT_NEAR(p.f[n + i],
                -3.0 * sigma_tr * std::exp(-cube.medium.sigma_t() / sigma_tr) * E / (4.0 * pi),
                1e-15);
  }
  EXPECT_EQ(p.f.head(n).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(p.f.tail(2 * n).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(p.outside, 0.0);
  // A tenth of the coefficients: the mean free path is the cube's side, all lamps are on or behind
  // the far face.
  const LitBody thin{LitShape::cube, thesis_medium(0.99)};
  EXPECT_EQ(thesis_problem(thin, setup).outside, 1.0);
}

TEST(ShapeError, KnowsNoFactorAndHidesNothing) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(5, 1.0, 2.0);
  EXPECT_NEAR(shape_error(7.0 * t, t), 0.0, 1e-15);
  EXPECT_EQ(shape_error(-t, t), 1.0);
  Eigen::VectorXd across(5);
  across << 1.0, -1.0, 0.0, 0.0, 0.0;
  const double s = across.dot(t);
  EXPECT_NEAR(shape_error(across, t),
              s < 0.0 ? 1.0 : std::sqrt(1.0 - s * s / (2.0 * t.squaredNorm())), 1e-12);
  Eigen::VectorXd bad = t;
  bad[2] = nan;
  EXPECT_TRUE(std::isnan(shape_error(bad, t)));
}

TEST(PoleToPole, CountsRings) {
  const auto field = [](double waves) {
    return [waves](const Points& x) -> Eigen::VectorXd {
      const Eigen::ArrayXd theta = (-x.row(0)).array().min(1.0).max(-1.0).acos();
      return 2.0 - theta / pi + 0.3 * (waves * theta).sin();
    };
  };
  EXPECT_EQ(pole_to_pole(field(0.0)).rings, 0);
  // Slope -1/pi + 0.3 * 8 cos 8 theta: eight turns inside, the first of them at once from the
  // pole, where it starts to rise.
  EXPECT_EQ(pole_to_pole(field(8.0)).rings, 9);
  EXPECT_NEAR(pole_to_pole(field(0.0)).unevenness, 0.0, 1e-12);
  EXPECT_NEAR(pole_to_pole(field(0.0)).lowest, 0.5, 1e-12);
  const auto tilted = [](const Points& x) -> Eigen::VectorXd { return x.row(1); };
  EXPECT_NEAR(pole_to_pole(tilted).unevenness, 1.0, 1e-12);
}

}  // namespace
}  // namespace knotlight
