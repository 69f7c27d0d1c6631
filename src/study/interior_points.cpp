// [V09 fig. 7.11]: further knots inside a ball.
#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/lit_line.h"

namespace knotlight {
namespace {

struct BallLayout {
  std::string name, words;
  std::vector<double> layers;  // depths in transport mean free paths
};

StudyFindings redo_interior_points(StudyBench& bench) {
  const LitBody ball{LitShape::ball, thesis_medium()};
  const RightAnswer& right = bench.bodies.right(ball);
  const PoleToPole truth = pole_to_pole(right.truth_at);
  const std::vector<BallLayout> layouts{{"(a)", "lamps only", {}},
                                        {"(b)", "3/2", {1.5}},
                                        {"(c)", "1/2, 3/2 and 2", {0.5, 1.5, 2.0}},
                                        {"(d)", "1/2, 3/2, 2 and 4", {0.5, 1.5, 2.0, 4.0}}};
  StudyTable table{
      "",
      "Layers of knots below the lamps' knots, depths in mean free paths; the ball has five "
      "from its surface to its centre. Off (c): least relative difference from the field of "
      "layout (c) over all factors; error: from what is right",
      {"way", "layers", "interior knots", "c", "rank, source matrix", "rings", "off (c)", "error"},
      {{"the thesis", "(a), (b), (c)", nan, nan, nan, nan, "visibly", "not correct"},
       {"the thesis", "(d): (c) and some near the centre", nan, nan, nan, nan, "hardly",
        "not correct"}}};
  StudyChart chart{"",
                   {"Layers of knots inside a ball",
                    "degrees from the lit pole",
                    "mean field, after the best factor",
                    false,
                    false,
                    {}},
                   "Gaussians with c = 10."};
  for (const double c : {500.0, 10.0}) {
    std::vector<Eigen::VectorXd> values;
    const std::size_t before = table.rows.size();
    for (const BallLayout& layout : layouts) {
      ThesisSetup setup = usual_setup(ball, bench.options.quick, bench.run.options.seed);
      setup.options.c = c;
      setup.layers = layout.layers;
      const ThesisProblem problem = thesis_problem(ball, setup);
      const ThesisAnswer answer = thesis_answer(problem, setup.options);
      const FieldValues u = [&](const Points& x) { return answer.field.values(x); };
      values.push_back(u(right.positions));
      const PoleToPole line = pole_to_pole(u);
      table.rows.push_back({"after its method", layout.name + " " + layout.words,
                            static_cast<double>(problem.problem.interior_points.cols()), c,
                            static_cast<double>(answer.particular_rank),
                            static_cast<double>(line.rings), nan,
                            shape_error(values.back(), right.truth)});
      if (c == 10.0)
        chart.chart.series.push_back(
            series_of(layout.name, line, best_factor(line.mean, truth.mean)));
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      table.rows[before + i][6] = shape_error(values[i], values[2]);
  }
  table.rows.push_back({"as it should be: patches, photons", "none", 0.0, nan, nan,
                        static_cast<double>(pole_to_pole(right.ours_at).rings), nan, right.error});
  chart.chart.series.push_back(series_of("right", truth, 1.0));
  return {{std::move(table)},
          {std::move(chart)},
          "As in the cube (fig. 7.4), every further layer of zeros is another source. Knots "
          "near the centre matter least, as the thesis says: what they add is far from the "
          "surface, in mean free paths, and to functions as wide as these, points that come "
          "together at the centre are nearly one point. Not one layout is near to what is "
          "right by design; those that happen to be are so by the number of polynomials they "
          "leave."};
}

}  // namespace

Study interior_points_study() {
  return {"interior-points", "further knots inside a ball", "fig. 7.11",
          "Four layouts of interior knots give four results, none of them correct; further "
          "knots near the centre change nothing any more.",
          redo_interior_points};
}

}  // namespace knotlight
