#include "reference/ball_p1.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/legendre.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// 4 pi sigma_a times the integral of U_d over the ball, in panels that shrink towards the centre,
// where a lamp's field is singular but integrable.
template <class Ball>
double absorbed(const Ball& ball, const Medium& medium, double radius) {
  const Quadrature gauss = gauss_legendre(16);
  double sum = 0.0;
  double to = radius;
  for (int panel = 0; panel < 30; ++panel, to *= 0.5)
    for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
      const double r = 0.25 * to * (3.0 + gauss.nodes[i]);
      sum += 0.25 * to * gauss.weights[i] * 4.0 * pi * r * r * ball.U_d(r);
    }
  return 4.0 * pi * medium.sigma_a * sum;
}

// Left side minus right side of U'' + (2/r) U' - lambda^2 U = f, relative to f, by differences.
template <class Ball>
double equation_error(const Ball& ball, const DiffusionCoefficients& c, double r, double f) {
  const double step = 1e-3 * r;
  const double before = ball.U_d(r - step), here = ball.U_d(r), after = ball.U_d(r + step);
  const double second = (after - 2.0 * here + before) / (step * step);
  return (second + (after - before) / (step * r) - c.lambda * c.lambda * here - f) / f;
}

template <class Ball>
double robin_left_side(const Ball& ball, const DiffusionCoefficients& c, double radius) {
  const double step = 1e-4 * radius;  // one-sided, second order
  const double slope =
      (3.0 * ball.U_d(radius) - 4.0 * ball.U_d(radius - step) + ball.U_d(radius - 2.0 * step)) /
      (2.0 * step);
  return ball.U_d(radius) + c.k * slope;
}

TEST(GlowingBallP1, EquationBoundaryAndEnergy) {
  for (const double ior : {1.0, 1.4})
    for (const double sigma_a : {1e-6, 1e-3, 0.5}) {
      const Medium medium{sigma_a, 8.0, 0.5, ior, 2.0};
      const DiffusionCoefficients c = diffusion_coefficients(medium, Boundary::milne);
      const GlowingBallP1 ball(medium, Boundary::milne, 1.5);
      EXPECT_LT(std::abs(equation_error(ball, c, 0.8, c.source_per_E * medium.emission)), 1e-4);
      EXPECT_NEAR(robin_left_side(ball, c, 1.5), 0.0, 1e-5 * ball.U_d(0.0));
      EXPECT_NEAR(absorbed(ball, medium, 1.5), ball.power_absorbed(),
                  1e-6 * (ball.power_leaving() + ball.power_absorbed()));
    }
}

// The limit is joined without a step, and without absorption all power leaves.
TEST(GlowingBallP1, WithoutAbsorption) {
  const GlowingBallP1 none({0.0, 8.0, 0.0, 1.0, 2.0}, Boundary::marshak, 1.5);
  const GlowingBallP1 little({1e-10, 8.0, 0.0, 1.0, 2.0}, Boundary::marshak, 1.5);
  EXPECT_NEAR(none.U_d(0.7) / little.U_d(0.7), 1.0, 1e-7);
  EXPECT_NEAR(none.power_absorbed(), 0.0, 1e-12 * none.power_leaving());
}

TEST(LampInBallP1, EquationBoundaryAndEnergy) {
  for (const double ior : {1.0, 1.4})
    for (const double g : {0.0, 0.8})
      for (const double sigma_a : {0.01, 0.5}) {
        const Medium medium{sigma_a, 9.0, g, ior, 0.0};
        const DiffusionCoefficients c = diffusion_coefficients(medium, Boundary::marshak);
        const double radius = 1.2;
        const LampInBallP1 ball(medium, Boundary::marshak, radius);
        for (const double r : {0.1, 0.4, 1.0})
          EXPECT_LT(std::abs(equation_error(ball, c, r, c.source_per_U_ri * ball.U_ri(r))), 1e-3);
        const double Q = g * medium.sigma_s * 4.0 * pi * ball.U_ri(radius);
        EXPECT_NEAR(robin_left_side(ball, c, radius), c.robin_data(Q), 1e-5 * ball.U_d(radius));
        // Independent of the equation: with g the point source at the lamp is what balances it.
        EXPECT_NEAR(absorbed(ball, medium, radius), ball.power_absorbed(), 1e-6);
      }
}

TEST(LampInBallP1, RefusesWhatItCannotDo) {
  EXPECT_THROW(LampInBallP1({0.0, 9.0, 0.0, 1.0, 0.0}, Boundary::marshak, 1.0), std::domain_error);
  EXPECT_THROW(LampInBallP1({9.0, 1.0, 0.0, 1.0, 0.0}, Boundary::marshak, 1.0), std::domain_error);
}

}  // namespace
}  // namespace knotlight
