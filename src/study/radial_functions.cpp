// [V09 fig. 7.9, 7.10]: which radial function, and how wide.
#include <fmt/format.h>

#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/lit_line.h"

namespace knotlight {
namespace {

struct Choice {
  std::string name, figure;
  RadialKind kind;
  double c, exponent;
};

std::vector<Choice> choices(bool quick) {
  using enum RadialKind;
  std::vector<Choice> all{
      {"Gaussian", "7.9 a, 7.10 c", gaussian, 500.0, 1.0},
      {"inverse multiquadric, beta = 3", "7.9 b", inverse_multiquadric, 1000.0, 3.0},
      {"Gaussian", "7.10 b", gaussian, 100.0, 1.0},
      {"Gaussian", "7.10 a", gaussian, 10.0, 1.0}};
  for (const double c : {5.0, 2.0, 1.0}) all.push_back({"Gaussian", "-", gaussian, c, 1.0});
  if (quick) return all;
  for (const auto& [name, kind] :
       {std::pair{"linear", linear}, {"cubic", cubic}, {"thin plate", thin_plate}})
    all.push_back({name, "-", kind, 1.0, 1.0});
  all.push_back({"multiquadric, beta = 1", "-", multiquadric, 1.0, 1.0});
  all.push_back({"compact C2", "-", compact_c2, 1.0, 1.0});
  return all;
}

StudyFindings redo_radial_functions(StudyBench& bench) {
  const LitBody ball{LitShape::ball, thesis_medium()};
  const RightAnswer& right = bench.bodies.right(ball);
  const PoleToPole truth = pole_to_pole(right.truth_at);
  StudyTable table{
      "",
      "A ball of radius 1 under the thesis's source, all else alike. Off 7.9 a: least relative "
      "difference from the field with Gaussians of c = 500 over all factors; error: the same "
      "from what is right, on the surface; as it should be without a factor",
      {"way", "function", "figure", "c", "rank, source matrix", "rings", "off 7.9 a", "error"},
      {{"the thesis", "Gaussian", "7.9 a", 500.0, nan, nan, 0.0, "not correct"},
       {"the thesis", "inverse multiquadric, beta = 3", "7.9 b", 1000.0, nan, nan, "alike",
        "not correct"},
       {"the thesis", "Gaussian", "7.10 b", 100.0, nan, nan, "strongly", "not correct"},
       {"the thesis", "Gaussian", "7.10 a", 10.0, nan, nan, "strongly", "not correct"}}};
  StudyChart chart{"",
                   {"Widths of the thesis",
                    "degrees from the lit pole",
                    "mean field, after the best factor",
                    false,
                    false,
                    {}},
                   "From the lit pole of the ball to the dark one."};
  Eigen::VectorXd first;
  for (const Choice& choice : choices(bench.options.quick)) {
    ThesisSetup setup = usual_setup(ball, bench.options.quick, bench.run.options.seed);
    setup.options.radial = choice.kind;
    setup.options.c = choice.c;
    setup.options.exponent = choice.exponent;
    const ThesisAnswer answer = thesis_answer(thesis_problem(ball, setup), setup.options);
    const FieldValues u = [&](const Points& x) { return answer.field.values(x); };
    const Eigen::VectorXd values = u(right.positions);
    if (first.size() == 0) first = values;
    const PoleToPole line = pole_to_pole(u);
    table.rows.push_back(
        {"after its method", choice.name, choice.figure, has_width(choice.kind) ? choice.c : nan,
         static_cast<double>(answer.particular_rank), static_cast<double>(line.rings),
         shape_error(values, first), shape_error(values, right.truth)});
    if (choice.figure != "-")
      chart.chart.series.push_back(series_of(fmt::format("{}, c = {}", choice.name, choice.c), line,
                                             best_factor(line.mean, truth.mean)));
  }
  table.rows.push_back({"as it should be: patches, photons", "none", "-", nan, nan,
                        static_cast<double>(pole_to_pole(right.ours_at).rings), nan, right.error});
  chart.chart.series.push_back(series_of("right", truth, 1.0));
  return {{std::move(table)},
          {std::move(chart)},
          "On a body of size 2 functions with c = 100, 500 or 1000 are all the same thing, 1 - "
          "r²/c² and hardly more, whatever their name: the same few polynomials above the cut "
          "and the same field. (The thesis sees a difference between 100 and 500; what lies at "
          "the cut is decided by rounding.) c = 10 lets a few more degrees in, which follow "
          "the layer of lamps no better and swing; narrow ones see their own knot only. The "
          "error has its minimum where nothing is resolved, so no width could have been right. "
          "A photon is a radial function, exp(-λr)/(4πr), whose weight is its power and whose "
          "width is the medium's."};
}

}  // namespace

Study radial_functions_study() {
  return {"radial-functions", "which radial function, and how wide", "fig. 7.9, 7.10",
          "Gaussians with c = 500 and inverse multiquadrics with c = 1000, beta = 3 give alike "
          "results; c = 10, 100 and 500 give different ones; none is correct.",
          redo_radial_functions};
}

}  // namespace knotlight
