// [V09 fig. 7.14]: a head and a creature. Here the Stanford bunny and the trefoil knot.
#include <fmt/format.h>

#include <cmath>

#include "core/not_finite.h"
#include "scene/scene_reader.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/timed_solve.h"

namespace knotlight {
namespace {

constexpr std::size_t model_checks = 500;
constexpr double model_truth_tolerance = 0.005, model_quick_tolerance = 0.1;
constexpr std::size_t model_photons = 1'000'000, model_truth_photons = 2'000'000,
                      model_quick_photons = 30'000;
constexpr std::size_t model_quick_knots = 100;
constexpr std::uint64_t model_seeds_apart =
    1000;  // seeds near to a run's own are those it judges itself by

struct Model {
  std::string name, file, stands_for;
};

struct Way {
  std::string words;
  Method method;
  SourceModel source;
};

struct SolvedModel {
  Eigen::VectorXd U_d;
  double error_estimate = 0.0, seconds = 0.0;
  std::vector<std::pair<std::string, double>> figures;
  std::vector<std::string> failures;

  double figure(const std::string& name) const {
    for (const auto& [key, value] : figures)
      if (key == name) return value;
    return nan;
  }
};

// The first channel alone, by the P1 equation.
Scene one_channel(const std::string& path) {
  Scene scene = read_scene(path);
  scene.channels = 1;
  scene.solver.diffusion = Diffusion::p1;
  return scene;
}

SolvedModel solve(Scene scene, const Points& at, std::uint64_t seed, int threads) {
  const auto [solved, seconds] = timed_solve(std::move(scene), seed, threads);
  SolvedModel result;
  result.seconds = seconds;
  const SolvedChannel& channel = solved.objects[0][0];
  result.U_d = channel.U_d(at);
  result.error_estimate = channel.report.error_estimate;
  result.figures = channel.report.figures;
  result.failures = solved.report.failures;
  return result;
}

const Object& translucent_of(const Scene& scene) {
  for (const Object& object : scene.objects)
    if (object.translucent() != nullptr) return object;
  return scene.objects.front();
}

std::string short_of(const std::vector<std::string>& failures) {
  return failures.empty() ? "yes" : "no: " + failures.front();
}

StudyFindings redo_models(StudyBench& bench) {
  const bool quick = bench.options.quick;
  const std::uint64_t seed = bench.run.options.seed;
  const int threads = bench.run.options.threads;
  const std::vector<Model> models{{"bunny", "bunny.yaml", "the head"},
                                  {"knot", "knot.yaml", "the creature"}};
  const std::vector<Way> ways{
      {"after its method: lamps at knots", Method::bkm_thesis, SourceModel::irradiance_thesis},
      {"its solver, photon map", Method::bkm_thesis, SourceModel::photon_map},
      {"as it should be: auto", Method::automatic, SourceModel::photon_map}};
  StudyTable table{"",
                   "The shipped scenes, first channel, U_d at 500 points of the surface "
                   "against a finer grid with other and more photons. Shape: error after the "
                   "best factor; trusted: whether the program itself says that the numbers can "
                   "be used",
                   {"model", "in place of", "way", "boundary knots", "interior knots", "seconds",
                    "error", "shape", "its own estimate", "trusted"},
                   {{"the thesis", "-", "a head, a kangaroo-like creature", nan, nan, nan, nan,
                     "pictures only, no figures", nan, "-"}}};
  std::vector<StudyChart> charts;
  for (const Model& model : models) {
    if (quick && model.name != "knot") continue;
    const std::filesystem::path path = bench.options.scenes / model.file;
    if (model.name == "bunny" &&
        !std::filesystem::exists(bench.options.scenes / "../.fetched/bunny.obj")) {
      table.rows.push_back({model.name, model.stands_for, "left out: its mesh is not fetched", nan,
                            nan, nan, nan, nan, nan, "-"});
      continue;
    }
    const Scene scene = one_channel(path.string());
    const Points at =
        columns(stratified_surface_points(translucent_of(scene).shape, model_checks, true,
                                          seed + model_seeds_apart, Stream::check_points))
            .positions;
    Scene fine = scene;
    fine.solver.method = Method::grid;
    fine.solver.tolerance = quick ? model_quick_tolerance : model_truth_tolerance;
    fine.solver.photons = quick ? 2 * model_quick_photons : model_truth_photons;
    const SolvedModel truth = solve(std::move(fine), at, seed + model_seeds_apart, threads);
    StudyChart chart{
        model.name,
        {"U_d on the " + model.name, "right", "found, times the best factor", false, false, {}},
        "Each point is a place on the surface; on the line it would be right."};
    for (const Way& way : ways) {
      Scene tried = scene;
      tried.solver.method = way.method;
      tried.solver.source = way.source;
      tried.solver.photons = quick ? model_quick_photons : model_photons;
      if (quick) {
        tried.solver.tolerance = model_quick_tolerance;
        tried.solver.knots = model_quick_knots;
      }
      const SolvedModel found = solve(std::move(tried), at, seed, threads);
      table.rows.push_back({model.name, model.stands_for, way.words, found.figure("boundary_knots"),
                            found.figure("interior_knots"), found.seconds,
                            (found.U_d - truth.U_d).norm() / truth.U_d.norm(),
                            shape_error(found.U_d, truth.U_d), found.error_estimate,
                            short_of(found.failures)});
      const double factor = found.U_d.dot(truth.U_d) / found.U_d.squaredNorm();
      ChartSeries series{way.words, {}, {}, {}, false, true};
      for (Eigen::Index i = 0; i < at.cols(); ++i) {
        series.x.push_back(truth.U_d[i]);
        series.y.push_back(factor * found.U_d[i]);
      }
      chart.chart.series.push_back(std::move(series));
    }
    chart.chart.series.push_back(
        {"right", {0.0, truth.U_d.maxCoeff()}, {0.0, truth.U_d.maxCoeff()}, {}, true, false, true});
    charts.push_back(std::move(chart));
  }
  return {{std::move(table)},
          std::move(charts),
          "What goes wrong on a ball goes wrong on a bunny, and folds and thin parts add to "
          "it: some hundred global functions, nearly constant across an ear, cannot tell its "
          "two sides apart. A picture hides that, as smooth light looks plausible whatever its "
          "values. The same solver on a photon map is no better, which puts the blame on dual "
          "reciprocity and the basis and not on the lamps alone; the program says of both that "
          "they are not to be trusted. Its own method takes seconds, and says how far off it "
          "is."};
}

}  // namespace

Study models_study() {
  return {"models",
          "a head and a creature",
          "fig. 7.14",
          "Pictures of a head and of the killeroo model, without figures; its conclusion is "
          "that the method, as it is, does not suit subsurface scattering.",
          redo_models,
          {"bunny.yaml", "knot.yaml"}};
}

}  // namespace knotlight
