// [V09 fig. 7.8]: rings on a ball lit from the left.
#include <fmt/format.h>

#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/lit_line.h"

namespace knotlight {
namespace {

StudyFindings redo_oscillation(StudyBench& bench) {
  const LitBody ball{LitShape::ball, thesis_medium()};
  const RightAnswer& right = bench.bodies.right(ball);
  const PoleToPole truth = pole_to_pole(right.truth_at);
  StudyTable table{
      "",
      "Mean of the field on circles about the lamp's axis. Rings: turns from falling to rising "
      "or back of more than 1 % of its largest size; lowest: its least value over its largest "
      "size; uneven: how far the field differs along the circles, where it should not; error "
      "after the best factor, as it should be without",
      {"way", "source", "c", "rank, source matrix", "rank, boundary matrix", "rings", "lowest",
       "uneven", "error"},
      {{"the thesis", "lamps at knots", nan, nan, nan, "several", nan, nan, nan}}};
  StudyChart chart{"",
                   {"From the lit pole of a ball to the dark one",
                    "degrees from the lit pole",
                    "mean field over its largest size",
                    false,
                    false,
                    {}},
                   "What only falls in truth goes up and down in the thesis's method."};
  for (const double c : {500.0, 10.0, 1.0}) {
    ThesisSetup setup = usual_setup(ball, bench.options.quick, bench.run.options.seed);
    setup.options.c = c;
    const ThesisAnswer answer = thesis_answer(thesis_problem(ball, setup), setup.options);
    const FieldValues u = [&](const Points& x) { return answer.field.values(x); };
    const PoleToPole line = pole_to_pole(u);
    table.rows.push_back(
        {"after its method", "lamps at knots", c, static_cast<double>(answer.particular_rank),
         static_cast<double>(answer.homogeneous_rank), static_cast<double>(line.rings), line.lowest,
         line.unevenness, shape_error(u(right.positions), right.truth)});
    chart.chart.series.push_back(
        series_of(fmt::format("c = {}", c), line, 1.0 / line.mean.cwiseAbs().maxCoeff()));
  }
  const PoleToPole ours = pole_to_pole(right.ours_at);
  table.rows.push_back({"as it should be: patches", "photons", nan, nan, nan,
                        static_cast<double>(ours.rings), ours.lowest, ours.unevenness,
                        right.error});
  chart.chart.series.push_back(series_of("right", truth, 1.0 / truth.mean.cwiseAbs().maxCoeff()));
  return {{std::move(table)},
          {std::move(chart)},
          "The thesis blames the unstable inversion, and a single singular value more or less "
          "above the cut does change the field by tens of per cent (study knots, c = 10). But "
          "no inversion could mend it: the functions that are left are a few dozen smooth "
          "polynomials, and a layer of lamps under a part of the surface has no good "
          "approximation among them. What they leave swings about the truth as any truncated "
          "expansion does, below zero too, and u_h, which must match the boundary condition of "
          "that, swings with it; the narrower the functions, the more often. The sum over "
          "photons has the layer exactly."};
}

}  // namespace

Study oscillation_study() {
  return {"oscillation", "rings on a ball", "fig. 7.8",
          "A ball lit from the left by a point light shows rings; the pseudo-inverse has "
          "replaced the oscillation of high frequency by one of low frequency.",
          redo_oscillation};
}

}  // namespace knotlight
