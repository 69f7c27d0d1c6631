// [V09 ch. 8.2]: lambda into a stable range by scaling the material.
#include <fmt/format.h>

#include <cmath>

#include "bkm/assembly.h"
#include "bkm/dense_solver.h"
#include "bkm/global_solver.h"
#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_ball.h"
#include "study/lit_body.h"
#include "study/manufactured_case.h"
#include "study/singular_values.h"

namespace knotlight {
namespace {

constexpr double side = 2.0;          // of the cube of the known solution
constexpr double width_of_one = 2.0;  // of the Gaussians, as in the study of fig. 7.1

// Digits that the values have in common, of the largest: 15.7 is all of them.
double digits_in_common(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const double difference = (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  if (std::isnan(difference)) return nan;
  return -std::log10(std::max(difference, std::numeric_limits<double>::epsilon()));
}

struct Scaled {
  Eigen::VectorXd u, outside;  // at the same places of the body
  int source_rank, boundary_rank;
  double source_condition, boundary_condition, outside_condition;
};

// The thesis's known solution with every length s times as long: lambda and the source shrink, k
// and the functions' width grow. And a boundary problem in the same cube, the wave exp(lambda d.x),
// by sources on a cube three times as large.
Scaled scaled_body(const ManufacturedProblem& p, double s) {
  constexpr double larger = 3.0, cut = 1e-13;
  BkmThesisProblem problem = p.problem;
  problem.lambda /= s;
  problem.k *= s;
  problem.boundary_points *= s;
  problem.interior_points *= s;
  BkmThesisOptions options;
  options.c = width_of_one * s;
  const BkmThesisSolver solver(problem, options);
  const Points checks = s * manufactured_checks();

  const Vec3 middle = Vec3::Constant(0.5 * side * s), d = Vec3(2.0, -1.0, 2.0) / 3.0;
  const Points& knots = problem.boundary_points;
  const Points sources = (larger * (knots.colwise() - middle)).colwise() + middle;
  const GlobalBkmSolver wave({problem.lambda, problem.k, sources, knots, problem.boundary_normals},
                             GlobalBasis::exterior_sources, cut, Workers(1));
  const double lambda = problem.lambda, k = problem.k;
  const Eigen::ArrayXd data =
      (lambda * (d.transpose() * knots).array()).exp() *
      (1.0 + k * lambda * (d.transpose() * problem.boundary_normals).array());
  const GlobalField field = wave.solve(data);
  Eigen::VectorXd outside(checks.cols());
  for (Eigen::Index i = 0; i < outside.size(); ++i) outside[i] = field.value(checks.col(i));
  return {solver.solve(p.f / (s * s), p.g).values(checks),
          outside,
          solver.particular_rank(),
          solver.homogeneous_rank(),
          solver.particular_condition(),
          solver.homogeneous_condition(),
          wave.condition()};
}

StudyTable together(bool quick) {
  const int n = quick ? 5 : 7;
  const ManufacturedProblem p = manufactured_problem(n, n - 1);
  const Scaled base = scaled_body(p, 1.0);
  StudyTable table{
      "",
      "Body and material scaled together: the known solution of fig. 7.1 in a cube of side 2 s "
      "with lambda / s, k s, source / s^2 and functions of width 2 s. Digits: that the field has "
      "in common with that of s = 1, of the largest value; also for a field without source by "
      "sources outside",
      {"s", "lambda", "lambda x side", "rank, source matrix", "rank, boundary matrix",
       "condition, source matrix", "condition, boundary matrix", "largest error", "digits",
       "condition, sources outside", "digits, sources outside"},
      {}};
  for (const double s : quick ? std::vector{1e-3, 0.125, 1.0, 1e3}
                              : std::vector{1e-3, 1e-2, 1e-1, 0.125, 1.0, 8.0, 1e1, 1e2, 1e3}) {
    const Scaled x = scaled_body(p, s);
    table.rows.push_back({s, p.problem.lambda / s, side * p.problem.lambda,
                          static_cast<double>(x.source_rank), static_cast<double>(x.boundary_rank),
                          x.source_condition, x.boundary_condition, manufactured_error(x.u),
                          digits_in_common(x.u, base.u), x.outside_condition,
                          digits_in_common(x.outside, base.outside)});
  }
  return table;
}

// A ball of five mean free paths, albedo 0.9, under a distant lamp whose light is boundary data;
// then its coefficients times s.
StudyTable material_alone(bool quick, std::uint64_t seed, StudyChart& chart) {
  constexpr double sigma_tr = 5.0, absorbed = 0.1;
  const double lambda = std::sqrt(3.0 * absorbed) * sigma_tr, k = 2.0 / (3.0 * sigma_tr);
  const SurfaceSamples knots = fibonacci_knots(quick ? 100 : 225);
  const Points checks = ball_knots(20, true, seed).positions;
  const Eigen::VectorXd truth = lit_ball_field(checks.row(2).transpose(), lambda, k);
  const Eigen::VectorXd data = knots.positions.row(2).transpose().unaryExpr(&lit_ball_data);
  StudyTable table{
      "material",
      "The material alone scaled: a ball of five mean free paths under a distant lamp, all of its "
      "coefficients times s. The first error is that of the closed form for the scaled material "
      "against the right one, the light as it is or scaled by the best factor; the last is what "
      "the boundary matrix adds to it",
      {"s", "lambda R", "k / R", "rank", "condition", "error, light as it is",
       "error, light scaled", "error of the numbers"},
      {}};
  ChartSeries plain{"light as it is", {}, {}, {}}, scaled{"light scaled", {}, {}, {}},
      numbers{"of the numbers", {}, {}, {}};
  for (const double s : quick ? std::vector{0.1, 1.0, 10.0}
                              : std::vector{1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
    const Eigen::VectorXd other = lit_ball_field(checks.row(2).transpose(), s * lambda, k / s);
    RadialFunction wave;
    wave.kind = RadialKind::nonsingular;
    wave.order = 0;
    wave.lambda = s * lambda;
    wave.R = 2.0;
    const DenseSolver solver(
        robin_matrix(knots.positions, knots.normals, knots.positions, k / s, wave));
    const Eigen::VectorXd u =
        robin_matrix(checks, Points::Zero(3, checks.cols()), knots.positions, 0.0, wave) *
        solver.solve(data);
    const double as_it_is = (other - truth).norm() / truth.norm();
    const double best = shape_error(other, truth), added = (u - other).norm() / other.norm();
    table.rows.push_back({s, s * lambda, k / s, static_cast<double>(solver.rank()),
                          solver.condition(), as_it_is, best, added});
    for (ChartSeries* series : {&plain, &scaled, &numbers}) series->x.push_back(s);
    plain.y.push_back(as_it_is);
    scaled.y.push_back(best);
    numbers.y.push_back(added);
  }
  chart.chart.series = {std::move(plain), std::move(scaled), std::move(numbers)};
  return table;
}

const char* const why =
    "Measured in units of the body's size R, the problem has two numbers, lambda R and k / R, "
    "besides its data: every entry of every matrix is a function of lambda r, k / r and r / c, all "
    "without a unit. lambda itself is whatever the unit of length makes of it. So if body and "
    "material are scaled together, lambda goes from 1732 to 0.0017 and rank, condition (but for "
    "the rounding that it consists of) and error stay. With powers of two every bit of the field "
    "does; else sources outside keep 14 digits, and the thesis's matrices seven: rounding the "
    "coordinates alone moves the others, which is what their condition means. If the material "
    "alone is scaled, lambda R and k / R do change, and the condition falls from 8e16 to 1e5 at s "
    "= 10. But that is the light in a body ten times as large: the field has another shape, and no "
    "factor on the light brings the right one back. The error is 4 % at best with s > 1, where "
    "only the surface is lit, and up to 76 % with s < 1; the right material, with its bad "
    "condition, has 0.6 %. And where the condition is good, the knots are too far apart for a "
    "field that dies out within 1 / lambda. There is no stable range to be brought into: what "
    "lambda R a body has is what one wants to know.";

StudyFindings redo_rescaling(StudyBench& bench) {
  StudyChart chart{
      "material",
      {"A material scaled", "its coefficients times", "relative error", true, true, {}},
      "What scaling the material does to the answer."};
  StudyTable material = material_alone(bench.options.quick, bench.run.options.seed, chart);
  return {{together(bench.options.quick), std::move(material)}, {std::move(chart)}, why};
}

}  // namespace

Study rescaling_study() {
  return {"rescaling", "lambda brought into a stable range", "ch. 8.2",
          "As lambda decides the stability, the material's coefficients could be scaled so that "
          "lambda falls into a stable range; the light has to be scaled too, and how well that "
          "works is to be examined.",
          redo_rescaling};
}

}  // namespace knotlight
