// [V09 fig. 7.13]: the material, or the cube, 10 and 100 times as large, and g = 0.
#include <fmt/format.h>

#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"

namespace knotlight {
namespace {

constexpr double cube_side = 2.0;

struct Material {
  std::string figure;
  double scale, g;
  std::string verdict;
};

StudyFindings redo_scaling(StudyBench& bench) {
  const std::vector<Material> materials{{"(a)", 1.0, usual_g, "no"},
                                        {"(b)", 10.0, usual_g, "reasonable"},
                                        {"(c)", 100.0, usual_g, "no"},
                                        {"(d)", 10.0, 0.0, "no"}};
  StudyTable table{
      "",
      "The cube of side 2 with its coefficients times a factor. Lamps outside: share of the "
      "thesis's lamps that lie outside the cube; lowest: least value on the surface over the "
      "largest; error: after the best factor for the thesis's method, none for the new one; "
      "estimate: what the new one says of itself",
      {"figure", "factor", "g", "thesis: good?", "side in mean free paths", "lambda x side", "c",
       "lamps outside", "rank, boundary matrix", "lowest", "error, its method",
       "error, as it should be", "estimate"},
      {}};
  StudyChart chart{"",
                   {"Error against the size in mean free paths",
                    "side in transport mean free paths",
                    "relative error on the surface",
                    true,
                    true,
                    {}},
                   "Factors 1, 10 and 100 at g = 0.85."};
  ChartSeries right_series{"as it should be", {}, {}, {}};
  std::vector<ChartSeries> series{{"its method, c = 500", {}, {}, {}},
                                  {"its method, c = 10", {}, {}, {}}};
  for (const Material& m : materials) {
    if (bench.options.quick && m.scale == 100.0) continue;
    const LitBody cube{LitShape::cube, thesis_medium(m.scale, m.g)};
    const RightAnswer& right = bench.bodies.right(cube);
    const double across = cube_side * cube.medium.sigma_tr();
    const double widths[] = {500.0, 10.0};
    for (std::size_t w = 0; w < 2; ++w) {
      ThesisSetup setup = usual_setup(cube, bench.options.quick, bench.run.options.seed);
      setup.options.c = widths[w];
      const ThesisProblem problem = thesis_problem(cube, setup);
      const ThesisAnswer answer = thesis_answer(problem, setup.options);
      const Eigen::VectorXd u = answer.field.values(right.positions);
      const double error = shape_error(u, right.truth);
      table.rows.push_back(
          {m.figure, m.scale, m.g, m.verdict, across, cube_side * problem.problem.lambda, widths[w],
           problem.outside, static_cast<double>(answer.homogeneous_rank),
           u.minCoeff() / u.cwiseAbs().maxCoeff(), error, right.error, right.error_estimate});
      if (m.g != usual_g) continue;
      series[w].x.push_back(across);
      series[w].y.push_back(error);
    }
    if (m.g != usual_g) continue;
    right_series.x.push_back(across);
    right_series.y.push_back(right.error);
  }
  chart.chart.series = {series[0], series[1], right_series};
  return {{std::move(table)},
          {std::move(chart)},
          "All of it depends on two numbers without a unit, the side in mean free paths and "
          "lambda times the side; whether size or coefficients change is the same. At the "
          "factor 1 the cube is one mean free path wide and the lamps of the lit faces stand "
          "at the dark ones. At 100 the layer of lamps is a hundredth of the cube thick, far "
          "below the distance of the knots, and lambda times the side is 50: each boundary "
          "function is a spike. With g = 0 the scattering counts in full: the cube is sixty "
          "mean free paths wide, more than half of the way from (b) to (c). So it is not g, "
          "nor lambda by itself, but knots per mean free path that decide, and (b) is best by "
          "them. No scaling of the unit of length can help. The photon sum has no such ratio "
          "in it; what grows with the size there is the photons' noise, and its estimate says "
          "so."};
}

}  // namespace

Study scaling_study() {
  return {"scaling", "a material scaled by 1, 10 and 100, and g = 0", "fig. 7.13",
          "Of factors 1, 10 and 100 with g = 0.85, and 10 with g = 0, only 10 with g = 0.85 "
          "gives a reasonable result.",
          redo_scaling};
}

}  // namespace knotlight
