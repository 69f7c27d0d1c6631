// [V09 fig. 7.4-7.6]: further knots inside a cube, in layers or on a lattice.
#include <cmath>

#include "bkm/knots.h"
#include "core/not_finite.h"
#include "study/experiments.h"
#include "study/lit_body.h"

namespace knotlight {
namespace {

constexpr double cube_volume = 8.0;
constexpr int slice_points = 21;  // of a slice, points
constexpr double edge = 0.05;
constexpr double slab = 0.26;  // half of it, about a slice: with 4 knots on an edge two are in it

struct CubeLayout {
  std::string name, words;
  std::vector<double> layers;
  bool lattice;
};

// A lattice of points in the plane where coordinate `axis` is 1.
Points slice(int axis) {
  Points x(3, slice_points * slice_points);
  const double step = (2.0 - 2.0 * edge) / (slice_points - 1);
  for (int i = 0; i < slice_points; ++i)
    for (int j = 0; j < slice_points; ++j) {
      Vec3 p = Vec3::Constant(1.0);
      p[axis == 0 ? 1 : 0] = edge + step * i;
      p[axis == 2 ? 1 : 2] = edge + step * j;
      x.col(i * slice_points + j) = p;
    }
  return x;
}

// How much of the light gets to the half of a slice that is further from the lamp.
double reach(const Eigen::VectorXd& u, const Points& x, const Vec3& lamp) {
  double near = 0.0, far = 0.0;
  const double middle = (Vec3::Constant(1.0) - lamp).norm();
  for (Eigen::Index i = 0; i < u.size(); ++i)
    ((x.col(i) - lamp).norm() < middle ? near : far) += u[i];
  return far / near;
}

ThesisSetup setup_of(const LitBody& cube, const CubeLayout& layout, const StudyBench& bench) {
  ThesisSetup setup = usual_setup(cube, bench.options.quick, bench.run.options.seed);
  setup.options.c = 10.0;  // of the thesis's widths the one that tells knots apart best
  setup.layers = layout.layers;
  if (layout.lattice)
    setup.more = grid_knots(setup.knots.positions, cube_volume,
                            2 * static_cast<std::size_t>(setup.knots.positions.cols()),
                            [&](const Vec3& x) { return cube.depth(x) > 0.0; })
                     .points;
  return setup;
}

// Knots that lie within `band` (length) of the middle slice.
ChartSeries places(const std::string& name, const ThesisProblem& p, double band) {
  ChartSeries series{name, {}, {}, {}, false, true};
  const Points& x = p.problem.interior_points;
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    if (std::abs(x(2, i) - 1.0) < band) {
      series.x.push_back(x(0, i));
      series.y.push_back(x(1, i));
    }
  return series;
}

StudyFindings redo_layouts(StudyBench& bench) {
  const LitBody cube{LitShape::cube, thesis_medium()};
  const RightAnswer& right = bench.bodies.right(cube);
  const Vec3 lamp = cube.lamp().position;
  const Points planes[] = {slice(2), slice(1)};
  const Eigen::VectorXd truths[] = {right.truth_at(planes[0]), right.truth_at(planes[1])};
  const std::vector<CubeLayout> layouts{{"(a)", "no more", {}, false},
                                        {"(b)", "3/2", {1.5}, false},
                                        {"(c)", "1/2 and 3/2", {0.5, 1.5}, false},
                                        {"(d)", "lattice", {}, true}};
  StudyTable table{
      "",
      "Slices z = 1 (fig. 7.4) and y = 1 (fig. 7.5). Reach: light in the far half of the slice "
      "over that in the near half. Off (d): least relative difference from the field of layout "
      "(d). Error: least relative difference from what is right, both after the best factor. "
      "Gaussians, c = 10",
      {"way", "knots beside lamps", "interior knots", "rank, source matrix", "reach, z = 1",
       "reach, y = 1", "off (d), z = 1", "error, z = 1", "error, y = 1"},
      {{"the thesis", "(a), (b), (c), (d)", nan, nan, "(a) most, (d) least", "as z = 1",
        "(b) nearer than (c)", nan, nan}}};
  StudyChart profile{"",
                     {"From the lit edge of the cube to the dark one",
                      "x = y, at z = 1",
                      "field, after the best factor",
                      false,
                      false,
                      {}},
                     "The field on the diagonal of the slice z = 1."};
  StudyChart where{"places",
                   {"Knots inside near the slice z = 1", "x", "y", false, false, {}},
                   "The layouts, as in fig. 7.6: each has the lamps, one mean free path under "
                   "the surface; what differs are the others."};
  Points diagonal(3, 39);
  for (Eigen::Index i = 0; i < diagonal.cols(); ++i) {
    const double s = 0.05 * static_cast<double>(i + 1);
    diagonal.col(i) = Vec3(s, s, 1.0);
  }
  const auto add_profile = [&](const std::string& name, const Eigen::VectorXd& u, double factor) {
    ChartSeries series{name, {}, {}, {}, true, false};
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      series.x.push_back(diagonal(0, i));
      series.y.push_back(factor * u[i]);
    }
    profile.chart.series.push_back(std::move(series));
  };
  std::vector<Eigen::VectorXd> in_plane[2];
  for (const CubeLayout& layout : layouts) {
    const ThesisSetup setup = setup_of(cube, layout, bench);
    const ThesisProblem problem = thesis_problem(cube, setup);
    const ThesisAnswer answer = thesis_answer(problem, setup.options);
    for (int s = 0; s < 2; ++s) in_plane[s].push_back(answer.field.values(planes[s]));
    const Eigen::VectorXd& u = in_plane[0].back();
    table.rows.push_back({"after its method", layout.name + " " + layout.words,
                          static_cast<double>(problem.problem.interior_points.cols()),
                          static_cast<double>(answer.particular_rank), reach(u, planes[0], lamp),
                          reach(in_plane[1].back(), planes[1], lamp), nan,
                          shape_error(u, truths[0]), shape_error(in_plane[1].back(), truths[1])});
    add_profile(layout.name, answer.field.values(diagonal), u.dot(truths[0]) / u.squaredNorm());
    where.chart.series.push_back(places(layout.name + " " + layout.words, problem, slab));
  }
  for (std::size_t i = 0; i < layouts.size(); ++i)
    table.rows[1 + i][6] = shape_error(in_plane[0][i], in_plane[0].back());
  const Eigen::VectorXd ours[] = {right.ours_at(planes[0]), right.ours_at(planes[1])};
  table.rows.push_back({"as it should be: patches", "none at all", 0.0, nan,
                        reach(ours[0], planes[0], lamp), reach(ours[1], planes[1], lamp), nan,
                        (ours[0] - truths[0]).norm() / truths[0].norm(),
                        (ours[1] - truths[1]).norm() / truths[1].norm()});
  add_profile("right", right.truth_at(diagonal), 1.0);
  return {{std::move(table)},
          {std::move(profile), std::move(where)},
          "The source is given at knots only: the lamps' own value one mean free path under "
          "the surface, and 0 elsewhere. What lies between is up to the radial functions, so a "
          "layout is not a refinement but another source, and the field follows it; no layout "
          "is right, since none says how much power there is. Zeros further inside cut the "
          "source off sooner: without them, (a), most light gets across. By distance from (d) "
          "the order is the thesis's, (b), (c), (a). As it should be, the source is what the "
          "photons left, each of them a term of the solution, and no knot inside is asked for."};
}

}  // namespace

Study layouts_study() {
  return {"layouts", "further knots inside", "fig. 7.4, 7.5, 7.6",
          "Light spreads less with a lattice of further interior knots (d) than with none (a); "
          "layers at 3/2 (b) or at 1/2 and 3/2 mean free paths (c) lie between, and (b), with "
          "fewer knots, is nearer to (d) than (c).",
          redo_layouts};
}

}  // namespace knotlight
