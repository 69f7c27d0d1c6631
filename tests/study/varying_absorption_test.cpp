#include "study/varying_absorption.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "reference/ball_p1.h"

namespace knotlight {
namespace {

// A ball of two absorptions, S = 1, in closed form: 1/sigma + a sinh(lambda r)/r inside of r0,
// 1/sigma + b sinh(lambda r)/r + c cosh(lambda r)/r outside; value and slope go on at r0.
double layered(double r, double r0, double k, double inner, double outer) {
  const double p = std::sqrt(inner), q = std::sqrt(outer);
  const auto sinh_r = [](double l, double x) { return std::sinh(l * x) / x; };
  const auto cosh_r = [](double l, double x) { return std::cosh(l * x) / x; };
  const auto sinh_slope = [](double l, double x) {
    return (l * x * std::cosh(l * x) - std::sinh(l * x)) / (x * x);
  };
  const auto cosh_slope = [](double l, double x) {
    return (l * x * std::sinh(l * x) - std::cosh(l * x)) / (x * x);
  };
  Eigen::Matrix3d m;
  m << sinh_r(p, r0), -sinh_r(q, r0), -cosh_r(q, r0),             //
      sinh_slope(p, r0), -sinh_slope(q, r0), -cosh_slope(q, r0),  //
      0.0, sinh_r(q, 1.0) + k * sinh_slope(q, 1.0), cosh_r(q, 1.0) + k * cosh_slope(q, 1.0);
  const Vec3 x = m.partialPivLu().solve(Vec3(1.0 / outer - 1.0 / inner, 0.0, -1.0 / outer));
  return r < r0 ? 1.0 / inner + x[0] * sinh_r(p, r)
                : 1.0 / outer + x[1] * sinh_r(q, r) + x[2] * cosh_r(q, r);
}

TEST(RadialDifferences, ATwoLayeredBallToSecondOrder) {
  constexpr double r0 = 0.5, k = 0.07, inner = 40.0, outer = 1.5;
  const auto error = [&](int n) {
    const Eigen::VectorXd u = radial_differences(
        n, {k, [](double r) { return r < r0 ? inner : outer; }, [](double) { return 1.0; }});
    double largest = 0.0;
    for (int i = 1; i <= n; ++i)
      largest = std::max(largest,
                         std::abs(u[i] - layered(static_cast<double>(i) / n, r0, k, inner, outer)));
    return largest;
  };
  EXPECT_LT(error(400), 2e-5);
  EXPECT_NEAR(error(100) / error(200), 4.0, 0.3);
}

TEST(RadialDifferences, TheGlowingBall) {
  const Medium medium{0.05, 9.95, 0.0, 1.0, 2.0};
  const DiffusionCoefficients c = diffusion_coefficients(medium, Boundary::marshak);
  const GlowingBallP1 ball(medium, Boundary::marshak, 1.0);
  const int n = 1000;
  const Eigen::VectorXd u = radial_differences(n, {c.k, [&](double) { return c.lambda * c.lambda; },
                                                   [&](double) { return -c.source_per_E * 2.0; }});
  for (const int i : {0, 500, n})
    EXPECT_NEAR(u[i] / ball.U_d(static_cast<double>(i) / n), 1.0, 1e-5) << i;
}

// div(spread grad U) = -6 for U = 2 - r^2, whatever spread(r), if the source is its divergence.
TEST(RadialDifferences, ADiffusionCoefficientThatVaries) {
  const auto spread = [](double r) { return 2.0 - r * r; };
  // -1/r^2 (r^2 (2 - r^2) (-2r))' = 12 - 10 r^2.
  RadialProblem p{0.5, [](double) { return 0.0; }, [](double r) { return 12.0 - 10.0 * r * r; },
                  spread};
  const int n = 400;
  const Eigen::VectorXd u = radial_differences(n, p);  // 2 - 1 + 0.5 (-2) = 0 at the surface
  for (int i = 0; i <= n; i += 50) {
    const double r = static_cast<double>(i) / n;
    EXPECT_NEAR(u[i], 2.0 - r * r, 2e-5) << r;
  }
}

// U = prod cos(a (x_i - 1)) in [0, 2]^3 obeys U + k dU/dn = 0 for a tan a = 1/k, and with any sigma
// the equation for S = (3 a^2 + sigma) U.
TEST(CubeDifferences, AKnownSolutionToSecondOrder) {
  const double a = 0.9;
  CubeProblem p;
  p.side = 2.0;
  p.k = 1.0 / (a * std::tan(a));
  const auto u = [a](const Vec3& x) { return (a * (x.array() - 1.0)).cos().prod(); };
  p.sigma = [](const Vec3& x) {
    return 1.0 + 20.0 * std::exp(-(x - Vec3(1, .7, .5)).squaredNorm());
  };
  p.source = [&](const Vec3& x) { return (3.0 * a * a + p.sigma(x)) * u(x); };
  const auto error = [&](int n) {
    const CubeSolution solution = cube_differences(n, p, 1e-10);
    EXPECT_TRUE(solution.converged);
    double largest = 0.0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int l = 0; l <= n; ++l)
          largest = std::max(largest, std::abs(solution.at(i, j, l) - u(2.0 / n * Vec3(i, j, l))));
    return largest;
  };
  const double coarse = error(8), fine = error(16);
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

// The power of a steep source is right on any grid: absorbed and leaving light add up to it.
TEST(CubeDifferences, ASteepSourceKeepsItsPower) {
  CubeProblem p;
  p.side = 2.0;
  p.k = 0.2;
  p.steep = 5.0;
  p.sigma = [](const Vec3&) { return 1.0; };
  p.source = [](const Vec3&) { return 3.0; };
  const int n = 8;
  const CubeSolution solution = cube_differences(n, p, 1e-12);
  double absorbed = 0.0, leaving = 0.0;
  const double h = p.side / n;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int l = 0; l <= n; ++l) {
        const auto width = [&](int at) { return at == 0 || at == n ? 0.5 * h : h; };
        const double volume = width(i) * width(j) * width(l);
        absorbed += volume * solution.at(i, j, l);
        for (const int at : {i, j, l})
          if (at == 0 || at == n) leaving += volume / width(at) * solution.at(i, j, l) / p.k;
      }
  EXPECT_NEAR(absorbed + leaving, 3.0 * 4.0 * -std::expm1(-10.0) / 5.0, 1e-9);
}

}  // namespace
}  // namespace knotlight
