#include "bkm/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bkm/bkm_cases.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

// Solutions of lap w - lambda^2 w = -1 in the ball of radius R with w + k dw/dn = 0: at the centre
// w = (1 - 1/(i_0 + k lambda i_1)) / lambda^2, with i_0, i_1 at lambda R; R (R + 2 k)/6 for lambda
// = 0.
double largest_response(double lambda, double k, double R) {
  if (lambda == 0.0) return R * (R + 2.0 * k) / 6.0;
  const double x = lambda * R;
  const double i0 = std::sinh(x) / x, i1 = std::cosh(x) / x - std::sinh(x) / (x * x);
  return (1.0 - 1.0 / (i0 + k * lambda * i1)) / (lambda * lambda);
}

TEST(Certificate, GainBoundsTheBall) {
  for (const double R : {0.3, 1.0, 5.0})
    for (const double k : {0.0, 0.1, 2.0})
      for (const double lambda : {0.0, 1e-3, 0.3, 1.0, 5.0, 40.0}) {
        const double exact = largest_response(lambda, k, R);
        const double gain = source_gain(lambda, k, R);
        EXPECT_GE(gain, exact * (1.0 - 1e-9)) << lambda << " " << k << " " << R;
        // Never above four times what the ball itself does: worst where lambda R is about 2.
        EXPECT_LE(gain, 4.0 * exact);
      }
  EXPECT_DOUBLE_EQ(source_gain(0.0, 0.7, 2.0), largest_response(0.0, 0.7, 2.0));
}

struct Checks {
  Surface surface;
  Points interior;
};

Certificate certify(const BkmField& field, const BkmThesisProblem& p, const Checks& checks,
                    const Exact& exact) {
  const Data d = data_of(exact, problem(checks.surface, checks.interior, p.lambda, p.k));
  return knotlight::certify(field, p, checks.surface.points, checks.surface.normals, d.g,
                            checks.interior, d.f.tail(checks.interior.cols()));
}

TEST(Certificate, BoundsTheErrorOfASolve) {
  for (const double lambda : {0.3, 1.7, 6.0})
    for (const int knots : {60, 120, 240}) {
      const double k = 0.3;
      const BkmThesisProblem p = problem(sphere(knots), cube_grid(4, -0.6, 1.2), lambda, k);
      const Exact exact = thesis_case(lambda);
      const Data d = data_of(exact, p);
      const BkmField field = BkmThesisSolver(p, {1.5, -1.0}).solve(d.f, d.g);
      const Points interior = 0.99 * star_checks(sphere(301));
      const Checks checks{sphere(351), interior};
      const Certificate c = certify(field, p, checks, exact);
      const Points everywhere = star_checks(sphere(500));
      const double error = max_error(field, exact, everywhere);
      EXPECT_TRUE(c.trusted);
      EXPECT_GE(c.error_bound, error) << lambda << " " << knots;
      // A bound that is far too wide would be as useless as a wrong one: the residuals of an
      // oscillating error exceed it by about the number of its waves.
      EXPECT_LE(c.error_bound, 300.0 * error) << lambda << " " << knots;
      EXPECT_NEAR(c.scale, max_size(exact, everywhere), 0.05 * c.scale + error);
      // Relative to the true field, not to the computed one.
      EXPECT_GE(c.error_estimate, error / max_size(exact, everywhere));
      EXPECT_LE(c.robin_residual_rms, c.robin_residual_max);
      EXPECT_LE(c.source_residual_rms, c.source_residual_max);
    }
}

// The zero field against f = -1 in a ball without absorption: the bound is the error itself, but
// for the margin of the radius.
TEST(Certificate, SharpForABallOfLaplace) {
  const double k = 0.4;
  const BkmThesisProblem p = problem(sphere(200), Points(3, 0), 0.0, k);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(200);
  const BkmField field = BkmThesisSolver(p, {1.0, -1.0}).solve(zero, zero);
  const Points inside = 0.5 * sphere(50).points;
  const Certificate c = knotlight::certify(field, p, sphere(150).points, sphere(150).normals,
                                           zero.head(150), inside, -Eigen::VectorXd::Ones(50));
  const double error = largest_response(0.0, k, 1.0);
  EXPECT_EQ(c.source_residual_rms, 1.0);
  EXPECT_GE(c.error_bound, error);
  EXPECT_LE(c.error_bound, 1.05 * 1.05 * error);
  EXPECT_TRUE(std::isinf(c.error_estimate));  // the field is 0, and known to be wrong
}

TEST(Certificate, NothingToSolveIsExact) {
  const BkmThesisProblem p = problem(sphere(50), Points(3, 0), 1.0, 0.5);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(60);
  const Certificate c = knotlight::certify(BkmField(), p, sphere(60).points, sphere(60).normals,
                                           zero, Points(3, 0), Eigen::VectorXd(0));
  EXPECT_TRUE(c.trusted);
  EXPECT_EQ(c.error_estimate, 0.0);
}

TEST(Certificate, NotFiniteIsNeverTrusted) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BkmThesisProblem p = problem(sphere(80), Points(3, 0), 1.0, 0.5);
  const Exact wave = plane_wave(1.0, Vec3(1.0, 0.0, 1.0));
  const Data d = data_of(wave, p);
  const BkmThesisSolver solver(p, {1.0, -1.0});
  const BkmField good = solver.solve(d.f, d.g);
  const Checks checks{sphere(90), 0.7 * sphere(30).points};
  EXPECT_TRUE(certify(good, p, checks, wave).trusted);

  Data bad = d;
  bad.g(5) = nan;
  const Certificate broken_field = certify(solver.solve(bad.f, bad.g), p, checks, wave);
  EXPECT_FALSE(broken_field.trusted);
  EXPECT_TRUE(std::isnan(broken_field.error_estimate));

  // One bad datum in the middle of the others, on the boundary and inside.
  for (const double value : {nan, std::numeric_limits<double>::infinity()})
    for (const bool on_boundary : {true, false}) {
      Data c = data_of(wave, problem(checks.surface, checks.interior, 1.0, 0.5));
      Eigen::VectorXd f = c.f.tail(30);
      (on_boundary ? c.g(41) : f(17)) = value;
      const Certificate untrusted = knotlight::certify(
          good, p, checks.surface.points, checks.surface.normals, c.g, checks.interior, f);
      EXPECT_FALSE(untrusted.trusted);
      EXPECT_TRUE(std::isnan(untrusted.error_estimate));
    }

  Checks misplaced = checks;
  misplaced.interior(1, 4) = nan;
  const Certificate lost =
      knotlight::certify(good, p, checks.surface.points, checks.surface.normals,
                         data_of(wave, problem(checks.surface, Points(3, 0), 1.0, 0.5)).g,
                         misplaced.interior, Eigen::VectorXd::Zero(30));
  EXPECT_FALSE(lost.trusted);
}

}  // namespace
}  // namespace knotlight
