// The method loses its solution when distances are rounded to float, as PBRT's points once did
// [V09 ch. 7, fig. 7.3]: a rounding of 6e-8 in the matrices, divided by singular values down to
// 1e-13. The same solve is written out here one kernel at a time, with and without the rounding; it
// is also the oracle for BkmThesisSolver.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bkm/bkm_cases.h"
#include "bkm/dense_solver.h"
#include "bkm/kernels.h"
#include "bkm/thesis_solver.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

constexpr double lo = 0.0, side = 2.0, k = 1.0, c = 2.0;
const double lambda = std::sqrt(3.0);
const double scale_R = side * std::sqrt(3.0);

double as_double(double r) {
  return r;
}
double as_float(double r) {
  return static_cast<double>(static_cast<float>(r));
}

// Largest error of [V09 5.20-5.29] with every distance passed through `round`.
double error_with(double (*round)(double), const BkmThesisProblem& p, const Exact& exact,
                  const Points& checks) {
  const Eigen::Index n = p.boundary_points.cols(), all = n + p.interior_points.cols();
  Points centers(3, all);
  centers << p.boundary_points, p.interior_points;
  const auto distance = [&](const Vec3& x, Eigen::Index j) {
    return round((x - centers.col(j)).norm());
  };
  // dr/dn [V09 6.14], 0 at the point itself.
  const auto slope = [&](Eigen::Index i, Eigen::Index j) {
    return i == j ? 0.0
                  : (centers.col(i) - centers.col(j)).dot(p.boundary_normals.col(i)) /
                        distance(centers.col(i), j);
  };

  Eigen::MatrixXd phi(all, all), boundary(n, n);
  for (Eigen::Index i = 0; i < all; ++i)
    for (Eigen::Index j = 0; j < all; ++j)
      phi(i, j) = gaussian_helmholtz(distance(centers.col(i), j), c, lambda);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const RadialValue w = nonsingular_solution(distance(centers.col(i), j), lambda, scale_R);
      boundary(i, j) = w.value + k * w.derivative * slope(i, j);
    }

  const Data d = data_of(exact, p);
  const Eigen::VectorXd alpha = DenseSolver(phi).solve(d.f);
  Eigen::VectorXd rest = d.g;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < all; ++j) {
      const RadialValue w = gaussian(distance(centers.col(i), j), c);
      rest(i) -= alpha(j) * (w.value + k * w.derivative * slope(i, j));
    }
  const Eigen::VectorXd beta = DenseSolver(boundary).solve(rest);

  double largest = 0.0;
  for (Eigen::Index i = 0; i < checks.cols(); ++i) {
    double u = 0.0;
    for (Eigen::Index j = 0; j < all; ++j)
      u += alpha(j) * gaussian(distance(checks.col(i), j), c).value;
    for (Eigen::Index j = 0; j < n; ++j)
      u += beta(j) * nonsingular_solution(distance(checks.col(i), j), lambda, scale_R).value;
    largest = std::max(largest, std::abs(u - exact.u(checks.col(i))));
  }
  return largest;
}

TEST(FloatDistance, LosesTheSolution) {
  const BkmThesisProblem p = problem(cube_faces(6, lo, side), cube_grid(5, lo, side), lambda, k);
  const Exact exact = thesis_case(lambda);
  const Points checks = cube_checks(400, lo, side);
  const double in_double = error_with(as_double, p, exact, checks);
  const double in_float = error_with(as_float, p, exact, checks);
  EXPECT_LT(in_double, 1e-4);
  EXPECT_GT(in_float, 100.0 * in_double);

  // Both systems are cut where rounding begins, so two orders of rounding agree to within the
  // error itself, not to the last bits.
  const Data d = data_of(exact, p);
  const double of_solver = max_error(BkmThesisSolver(p, {c, -1.0}).solve(d.f, d.g), exact, checks);
  EXPECT_LT(of_solver, 3.0 * in_double);
  EXPECT_GT(of_solver, in_double / 3.0);

  // The option: coordinates and all arithmetic of distances in float.
  BkmThesisOptions in_floats{c, -1.0};
  in_floats.precision = DistancePrecision::single_precision;
  const double of_floats = max_error(BkmThesisSolver(p, in_floats).solve(d.f, d.g), exact, checks);
  EXPECT_GT(of_floats, 100.0 * in_double);
  RecordProperty("error_of_option", fmt::format("{:.3g}", of_floats));
  RecordProperty("error_in_double", fmt::format("{:.3g}", in_double));
  RecordProperty("error_in_float", fmt::format("{:.3g}", in_float));
}

}  // namespace
}  // namespace knotlight
