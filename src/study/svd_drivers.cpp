// [V09 table 7.2]: which routine decomposes the source matrix.
#include <fmt/format.h>

#include <array>
#include <map>

#include "bkm/assembly.h"
#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/svd_routines.h"

namespace knotlight {
namespace {

constexpr int per_edge[] = {3, 6, 9};  // 108, 432, 972 knots: twelve triangles, n x n each

// [V09 table 7.2], seconds for all coefficients.
const std::map<SvdRoutine, std::array<double, 3>> table_72{
    {SvdRoutine::sgesvd, {0.44, 54.03, 684.80}}, {SvdRoutine::sgesdd, {0.28, 27.20, 356.42}}};

// QR iteration in double and Jacobi's rotations take minutes for the largest.
bool too_slow(SvdRoutine routine, int n) {
  return n == 9 && (routine == SvdRoutine::dgesvd || routine == SvdRoutine::dgejsv);
}

std::string words(SvdRoutine routine) {
  const std::string name = name_of(routine);
  if (routine == SvdRoutine::sampled) return "as it should be: random products, what is kept only";
  if (name.substr(1) == "gesvd") return name + ", QR iteration";
  return name + (routine == SvdRoutine::dgejsv ? ", Jacobi" : ", divide and conquer");
}

StudyFindings redo_svd_drivers(StudyBench& bench) {
  const LitBody cube{LitShape::cube, thesis_medium()};
  StudyTable table{
      "",
      "The source matrix of a cube (Gaussians, c = 10, three times as large as the boundary "
      "knots are many) decomposed by each routine on one core; residual: |A - U S V^T| / |A|; "
      "kept: singular values above max(m, n) times the routine's own 2^-23 or 2^-52. Routines "
      "that take minutes for the largest are left out there",
      {"routine", "boundary knots", "matrix size", "seconds, thesis", "seconds, here",
       "seconds, thesis over here", "residual", "kept"},
      {}};
  StudyChart chart{"",
                   {"Time to decompose", "matrix size", "seconds", true, true, {}},
                   "The thesis's times are for all coefficients, of which the decomposition is "
                   "nearly all; a Core 2 Duo of 2 GHz in 2009."};
  const std::size_t sizes = bench.options.quick ? 1 : std::size(per_edge);
  for (const SvdRoutine routine : svd_routines()) {
    const auto thesis = table_72.find(routine);
    ChartSeries here{name_of(routine), {}, {}, {}};
    ChartSeries there{name_of(routine) + ", thesis", {}, {}, {}, true, true, true};
    for (std::size_t i = 0; i < sizes; ++i) {
      const int n = per_edge[i];
      if (too_slow(routine, n)) continue;
      ThesisSetup setup = usual_setup(cube, bench.options.quick, bench.run.options.seed);
      setup.knots = cube_triangle_knots(n);
      setup.options.c = 10.0;
      const ThesisProblem problem = thesis_problem(cube, setup);
      const Eigen::MatrixXd a = source_matrix(
          all_points(problem.problem), radial_function(setup.options, problem.problem.lambda, 1.0));
      const SvdRun run = run_svd(routine, a);
      const double seconds = thesis == table_72.end() ? nan : thesis->second[i];
      const auto size = static_cast<double>(a.rows());
      table.rows.push_back({words(routine), size / 3.0, size, seconds, run.seconds,
                            seconds / run.seconds, run.residual, static_cast<double>(run.kept)});
      here.x.push_back(size);
      here.y.push_back(run.seconds);
      there.x.push_back(size);
      there.y.push_back(seconds);
    }
    chart.chart.series.push_back(std::move(here));
    if (thesis != table_72.end()) chart.chart.series.push_back(std::move(there));
  }
  return {{std::move(table)},
          {std::move(chart)},
          "Divide and conquer beats QR iteration here too, and by more than the thesis's "
          "factor of two: most of its work is matrix products, which today's libraries do "
          "well. In single precision, for which the names of the routines stand, four to seven "
          "singular values are left where double has some fifty: the figures of table 7.1 are "
          "of double precision. Within a precision all routines agree to rounding. But hardly "
          "any of what they compute is used: products with random columns find the range of "
          "the matrix as far as it lies above the cut, and only that is decomposed."};
}

}  // namespace

Study svd_drivers_study() {
  return {"svd-drivers", "which routine decomposes", "table 7.2",
          "LAPACK's gesdd takes half the time of gesvd, with the same result: 0.28, 27 and 356 "
          "s for 108, 432 and 972 boundary knots.",
          redo_svd_drivers};
}

}  // namespace knotlight
