// [V09 table 7.3, fig. 7.12]: how many knots, and how long they take.
#include "core/clock.h"
#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/lit_line.h"

namespace knotlight {
namespace {

struct Table73Row {
  int across;                 // knots: the square of it
  double solving, rendering;  // seconds
};
// [V09 table 7.3]
constexpr Table73Row table_73[] = {
    {10, 0.235, 6.2}, {22, 40.516, 25.8}, {31, 349.907, 50.2}, {42, 2378.219, 90.0}};

// A ball that fills a picture of 256 x 256 has some 40 000 pixels.
constexpr std::size_t pixels = 40'000;
constexpr double widest = 500.0;  // the width of most of the thesis's pictures, length

Points picture_points(const LitBody& ball, std::uint64_t seed) {
  return columns(stratified_surface_points(ball.shape(), pixels, true, seed, Stream::check_points))
      .positions;
}

StudyFindings redo_knots(StudyBench& bench) {
  const LitBody ball{LitShape::ball, thesis_medium()};
  const RightAnswer& right = bench.bodies.right(ball);
  const PoleToPole truth = pole_to_pole(right.truth_at);
  const Points picture = picture_points(ball, bench.run.options.seed);
  const std::size_t count = bench.options.quick ? 2 : std::size(table_73);
  StudyTable table{
      "",
      "The ball of fig. 7.12, Gaussians of width c. Coefficients: matrices, decompositions, "
      "solutions; evaluation: the field at 40 000 points of the surface, what a picture needs "
      "of it (the thesis gives whole pictures of a size it does not say). Off most: least "
      "relative difference from the field of the most knots over all factors; error: from what "
      "is right; as it should be without",
      {"way", "c", "boundary knots", "seconds, coefficients, thesis", "seconds, coefficients",
       "seconds, picture, thesis", "seconds, evaluation", "rank, source matrix",
       "rank, boundary matrix", "off most", "error"},
      {}};
  StudyChart chart{
      "",
      {"Time for the coefficients", "boundary knots", "seconds", true, true, {}},
      "Table 7.3, one core each; the thesis's is a Core 2 Duo of 2 GHz. The level line is all "
      "of the solve by patches, light included."};
  StudyChart lines{"lines",
                   {"Numbers of knots",
                    "degrees from the lit pole",
                    "mean field, after the best factor",
                    false,
                    false,
                    {}},
                   "Fig. 7.12: from the lit pole of the ball to the dark one; Gaussians, c = 500."};
  ChartSeries thesis{"the thesis", {}, {}, {}}, here{"after its method", {}, {}, {}};
  for (const double c : {widest, 10.0}) {
    std::vector<Eigen::VectorXd> values;
    for (std::size_t i = 0; i < count; ++i) {
      const Table73Row& row = table_73[i];
      ThesisSetup setup = usual_setup(ball, false, bench.run.options.seed);
      setup.options.c = c;
      setup.knots = ball_knots(row.across, true, bench.run.options.seed);
      const ThesisAnswer answer = thesis_answer(thesis_problem(ball, setup), setup.options);
      const double start = cpu_seconds();
      const Eigen::VectorXd seen = answer.field.values(picture);
      const double evaluation = cpu_seconds() - start;
      const FieldValues u = [&](const Points& x) { return answer.field.values(x); };
      values.push_back(u(right.positions));
      const double knots = row.across * row.across;
      table.rows.push_back({"after its method", c, knots, row.solving, answer.seconds,
                            row.rendering, seen.allFinite() ? evaluation : nan,
                            static_cast<double>(answer.particular_rank),
                            static_cast<double>(answer.homogeneous_rank), nan,
                            shape_error(values.back(), right.truth)});
      if (c != widest) continue;
      thesis.x.push_back(knots);
      thesis.y.push_back(row.solving);
      here.x.push_back(knots);
      here.y.push_back(answer.seconds);
      const PoleToPole line = pole_to_pole(u);
      lines.chart.series.push_back(series_of(std::to_string(row.across * row.across), line,
                                             best_factor(line.mean, truth.mean)));
    }
    const std::size_t first = table.rows.size() - count;
    for (std::size_t i = 0; i < count; ++i)
      table.rows[first + i][9] = shape_error(values[i], values.back());
  }
  const double start = cpu_seconds();
  const Eigen::VectorXd seen = right.ours_at(picture);
  const double evaluation = cpu_seconds() - start;
  table.rows.push_back({"as it should be: patches, photons", nan, nan, nan, right.seconds, nan,
                        seen.allFinite() ? evaluation : nan, nan, nan, nan, right.error});
  chart.chart.series = {thesis,
                        here,
                        {"as it should be",
                         {thesis.x.front(), thesis.x.back()},
                         {right.seconds, right.seconds},
                         {},
                         true,
                         false,
                         true}};
  lines.chart.series.push_back(series_of("right", truth, 1.0));
  return {{std::move(table)},
          {std::move(chart), std::move(lines)},
          "With c = 500 the field settles as knots are added, since the same nine or ten "
          "functions are left above the cut whatever their number; what it settles to is not "
          "the answer. That is the convergence the thesis sees. With c = 10, where a singular "
          "value lies at the cut, it may stay for long and then jump, when that value falls "
          "below. The rank of the boundary matrix does not grow either. The time grows as the "
          "cube of the knots for a full decomposition, and as their square times the rank for "
          "one that stops at the cut, which is how the same coefficients come hundreds of "
          "times faster, next to fifteen years of progress in processors. The method that is "
          "right costs what its photons cost, and knows its own error."};
}

}  // namespace

Study knots_study() {
  return {"knots", "how many knots", "table 7.3, fig. 7.12",
          "With 100, 484, 961 and 1764 boundary knots the coefficients take 0.235, 40.5, 349.9 "
          "and 2378.2 s, the pictures 6.2 to 90 s; the result converges: 961 and 1764 knots "
          "hardly differ.",
          redo_knots};
}

}  // namespace knotlight
