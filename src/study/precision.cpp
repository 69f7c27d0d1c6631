// [V09 fig. 7.3]: distances between knots in float and in double.
#include <fmt/format.h>

#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/manufactured_case.h"

namespace knotlight {
namespace {

constexpr double as_wide_as_the_cube = 2.0;  // as in the study of the manufactured solution

std::string name_of(DistancePrecision precision) {
  return precision == DistancePrecision::single_precision ? "float" : "double";
}

// Light, cube and knots are mirrored at z = 1: rms difference of u and its mirror image over the
// rms of u. The check points come with no mirror image among them.
double asymmetry(const FieldValues& u, const Points& at) {
  Points mirrored = at;
  mirrored.row(2) = 2.0 - at.row(2).array();
  const Eigen::VectorXd values = u(at);
  return (u(mirrored) - values).norm() / values.norm();
}

StudyFindings redo_precision(StudyBench& bench) {
  const LitBody cube{LitShape::cube, thesis_medium()};
  const RightAnswer& right = bench.bodies.right(cube);
  const int n = bench.options.quick ? 6 : 8;
  const ManufacturedProblem known = manufactured_problem(n, n - 1);
  StudyTable table{
      "",
      "Asymmetry: how far the field of the lit cube differs from its mirror image at the "
      "height of the lamp, rms over rms, at 600 points of its surface; it should be 0. Error: "
      "the largest one of the manufactured solution (fig. 7.1)",
      {"way", "distances", "width c", "asymmetry, lit cube",
       "error after the best factor, lit cube", "largest error, known solution"},
      {{"the thesis", "float", nan, "the top is brighter", nan, nan},
       {"the thesis", "double", nan, "symmetric", nan, nan}}};
  for (const double c : {500.0, 10.0, 2.0})
    for (const auto precision :
         {DistancePrecision::single_precision, DistancePrecision::double_precision}) {
      ThesisSetup setup = usual_setup(cube, bench.options.quick, bench.run.options.seed);
      setup.options.c = c;
      setup.options.precision = precision;
      const ThesisAnswer answer = thesis_answer(thesis_problem(cube, setup), setup.options);
      const FieldValues u = [&](const Points& x) { return answer.field.values(x); };
      double known_error = nan;
      if (c == as_wide_as_the_cube) {
        BkmThesisOptions options;
        options.c = as_wide_as_the_cube;
        options.precision = precision;
        known_error = manufactured_error(BkmThesisSolver(known.problem, options)
                                             .solve(known.f, known.g)
                                             .values(manufactured_checks()));
      }
      table.rows.push_back({"after its method", name_of(precision), c,
                            asymmetry(u, right.positions),
                            shape_error(u(right.positions), right.truth), known_error});
    }
  for (const auto precision :
       {DistancePrecision::single_precision, DistancePrecision::double_precision})
    table.rows.push_back({"as it should be: sources outside", name_of(precision),
                          as_wide_as_the_cube, nan, nan,
                          manufactured_error(manufactured_better(known, n, precision))});
  table.rows.push_back({"as it should be: patches", "double", nan,
                        asymmetry(right.ours_at, right.positions), right.error, nan});

  StudyChart chart{"",
                   {"Up the lit edge of the cube", "z", "field, 1 at z = 1", false, false, {}},
                   "The field along a line up the cube near its lit edge, x = y = 0.05, by the "
                   "thesis's method with c = 10."};
  Points line(3, 41);
  for (Eigen::Index i = 0; i < line.cols(); ++i)
    line.col(i) = Vec3(0.05, 0.05, 0.05 * static_cast<double>(i));
  const auto add = [&](const std::string& name, const Eigen::VectorXd& u) {
    ChartSeries series{name, {}, {}, {}, true, false};
    for (Eigen::Index i = 0; i < line.cols(); ++i) {
      series.x.push_back(line(2, i));
      series.y.push_back(u[i] / u[line.cols() / 2]);
    }
    chart.chart.series.push_back(std::move(series));
  };
  for (const auto precision :
       {DistancePrecision::single_precision, DistancePrecision::double_precision}) {
    ThesisSetup setup = usual_setup(cube, bench.options.quick, bench.run.options.seed);
    setup.options.c = 10.0;
    setup.options.precision = precision;
    add(name_of(precision),
        thesis_answer(thesis_problem(cube, setup), setup.options).field.values(line));
  }
  add("as it should be", right.ours_at(line));
  return {{std::move(table)},
          {std::move(chart)},
          "A float has 24 bits: a distance is off by up to 6e-8 of itself. The pseudo-inverse "
          "divides by singular values down to 1e-13 of the largest, so that this rounding "
          "comes out a million times as large, which is the light at the top of the thesis's "
          "cube. Double precision does not remove the cause: it moves the floor from 2^-24 to "
          "2^-53, and the loss from the picture into the digits behind it. Least squares over "
          "sources outside the body lose far less in float, since what multiplies the "
          "rounding, the condition, is smaller; the program computes all geometry of its "
          "solvers in double all the same. What asymmetry the patches have is the photons' "
          "noise."};
}

}  // namespace

Study precision_study() {
  return {"precision", "distances in float and in double", "fig. 7.3",
          "With distances in float, light seems to grow towards the top of a cube lit at half "
          "its height; in double, top and bottom are alike.",
          redo_precision};
}

}  // namespace knotlight
