#include "compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "compare/measure.h"
#include "compare/page.h"
#include "compare/slice.h"
#include "core/errors.h"
#include "core/file_io.h"
#include "pipeline/scene_setup.h"

namespace knotlight {
namespace {

constexpr std::array<SourceModel, 4> all_models = {
    SourceModel::photon_map, SourceModel::irradiance_sampling, SourceModel::irradiance_thesis,
    SourceModel::boundary_flux};

// The converged solution: second-order cells of 0.6 times the size leave 0.4 of the error, four
// times the photons at most half of the noise.
constexpr double converged_tolerance = 0.4;  // times the scene's
constexpr std::size_t converged_photons = 4;
// The seeds of the judges are not those of the judged.
constexpr std::uint64_t converged_seed = 1'000'003, truth_seed = 2'000'003, budget_seed = 3'000'017;

constexpr int widest_picture = 320;  // pixels: a page shows several side by side
constexpr int most_samples = 8;      // per pixel, of so small a picture

// Error against time: what a model's light is made of, from a quick look to the whole.
constexpr std::array<std::size_t, 4> photon_shares = {64, 16, 4, 1};  // of the comparison's photons
constexpr std::array<std::size_t, 4> irradiance_budgets = {500, 3'000, 18'000, 108'000};
constexpr std::array<std::size_t, 4> knot_budgets = {60, 120, 240, 480};

const ChannelReport& first_channel(const ModelRun& run, std::size_t object) {
  return run.solved->report.objects[object].channels.front();
}

// How many photons are enough is told by a first try in channel 0.
constexpr std::size_t pilot_photons = 30'000;
constexpr double noise_aimed_at = 0.7;  // tolerances: the model shows, not the noise

std::size_t photons_wanted(PreparedScene& prepared, const SolverSettings& base, std::size_t object,
                           const RunContext& run) {
  const std::size_t most = base.photons;
  if (most <= pilot_photons) return most;
  SolverSettings settings = base;
  settings.source = SourceModel::photon_map;
  settings.photons = pilot_photons;
  const int channels = std::exchange(prepared.scene.channels, 1);
  const ModelRun pilot = run_model(prepared, settings, run.options.seed, false, run);
  prepared.scene.channels = channels;
  if (!pilot.ran()) return most;
  // Noise falls at least as one over the root of the number.
  const double ratio = first_channel(pilot, object).noise / (noise_aimed_at * base.tolerance);
  const double wanted = static_cast<double>(pilot_photons) * ratio * ratio;
  if (!(wanted < static_cast<double>(most))) return most;
  return std::max(pilot_photons, static_cast<std::size_t>(wanted));
}

void shrink(Camera& camera) {
  camera.samples = std::min(camera.samples, most_samples);
  if (camera.width_px <= widest_picture) return;
  camera.height_px = std::max(1, camera.height_px * widest_picture / camera.width_px);
  camera.width_px = widest_picture;
}

// What a model's errors are measured at and against.
struct Yardstick {
  const SurfaceChecks& checks;
  Eigen::VectorXd surface;  // converged, at the checks
  Eigen::VectorXd inside;   // converged, at the cells of the truth
  ValueMap luminance;       // of the converged picture
};

ModelErrors measure(const ModelRun& run, const PreparedScene& prepared, std::size_t object,
                    const Yardstick& by, const Comparison& c, const RunContext& context) {
  const std::uint64_t seed = context.options.seed;
  const ChannelReport& report = first_channel(run, object);
  const Eigen::VectorXd inside =
      inner_U_d(run, object, c.truth.centers, c.truth.U_ri, context.workers);
  ModelErrors errors;
  errors.surface = relative_rms(at_checks(run, prepared, by.checks, seed, context.workers),
                                by.surface, by.checks.areas);
  errors.diffusion = relative_rms(inside, by.inside);
  errors.transport = relative_rms_beyond_noise(inside, c.truth.U_d, c.truth.U_d_error);
  errors.noise = report.noise;
  errors.numerical = report.numerical_error;
  errors.energy = report.energy_imbalance;
  return errors;
}

// The same scene in channel 0 alone, with less and more light to go by.
std::vector<BudgetPoint> sweep_budgets(PreparedScene& prepared, const SolverSettings& settings,
                                       const Yardstick& by, const RunContext& run, Stage& stage) {
  const int channels = std::exchange(prepared.scene.channels, 1);
  std::vector<BudgetPoint> points;
  for (std::size_t i = 0; i < photon_shares.size(); ++i) {
    SolverSettings own = settings;
    own.photons = std::max<std::size_t>(1, settings.photons / photon_shares[i]);
    own.irradiance_samples = irradiance_budgets[i];
    BudgetPoint point{static_cast<double>(own.photons), 0.0, 0.0};
    if (settings.source == SourceModel::irradiance_thesis) {
      own.knots = knot_budgets[i];
      point.budget = static_cast<double>(knot_budgets[i]);
    } else if (settings.source != SourceModel::photon_map) {
      point.budget = static_cast<double>(irradiance_budgets[i]);
    }
    const std::uint64_t seed = run.options.seed + budget_seed;
    const ModelRun model = run_model(prepared, own, seed, false, run);
    point.seconds = model.cost.solution();
    point.error = relative_rms(at_checks(model, prepared, by.checks, seed, run.workers), by.surface,
                               by.checks.areas);
    points.push_back(point);
    stage.advance();
  }
  prepared.scene.channels = channels;
  return points;
}

ValueMap slice_of(SourceModel model, PreparedScene& prepared, std::size_t object,
                  const Slice& slice, const RunContext& run) {
  Stages unseen(false);
  Stage stage(unseen, "slice", incident_light_work(prepared, model));
  const std::vector<IncidentLight> light =
      trace_incident_light(prepared, 0, model, run.options.seed, run.workers, stage);
  return source_slice(light[object], prepared, prepared.translucent[object], slice);
}

void write_tables(const Comparison& c, const std::filesystem::path& folder) {
  write_text_file((folder / "compare.csv").string(), compare_csv(c));
  write_text_file((folder / "lines.csv").string(), lines_csv(c));
  write_text_file((folder / "budgets.csv").string(), budgets_csv(c));
}

// Fields are compared as P1 has them, and so are pictures: gathered ones would show the noise of
// their samples beside the models, and need photons inside refracting objects, which most models do
// not have.
void choose_for_comparison(Scene& scene) {
  scene.solver.diffusion = Diffusion::p1;
  scene.solver.photons_at_most = false;
  if (!scene.solver.exitance) scene.solver.exitance = Exitance::p1;
}

}  // namespace

Comparison compare_models(const std::string& path, const CompareOptions& options, RunContext& run,
                          Scene& scene_out) {
  PreparedScene prepared = prepare_scene(path, run);
  if (prepared.translucent.empty())
    throw InputError(path + ": objects: none is translucent, expected one to compare models on");
  shrink(prepared.scene.camera);
  choose_for_comparison(prepared.scene);
  scene_out = prepared.scene;
  const SeenSurface seen = see_surface(prepared);
  const std::size_t object = seen.most_seen();
  {
    const Stage stage(run.stages, "pilot", 0);
    prepared.scene.solver.photons =
        options.photons ? *options.photons
                        : photons_wanted(prepared, prepared.scene.solver, object, run);
  }
  const SolverSettings base = prepared.scene.solver;
  const std::uint64_t seed = run.options.seed;

  Comparison c;
  c.scene_path = path;
  c.units = prepared.scene.units;
  c.tolerance = base.tolerance;
  c.photons = base.photons;
  const std::uint32_t index = prepared.translucent[object];
  c.object = prepared.scene.objects[index].name;
  c.sigma_tr = prepared.scene.objects[index].translucent()->medium(0).sigma_tr();

  c.no_truth = no_truth_because(prepared);
  c.truth = trace_truth(prepared, index, options.interactions, seed + truth_seed, run);
  c.lines = choose_lines(prepared, index, seed);
  for (std::size_t i = 0; i < c.lines.size(); ++i)
    c.line_cells[i] = cells_along(c.lines[i], c.truth);

  const SurfaceChecks checks = surface_checks(prepared, seed);
  Yardstick by{checks, {}, {}, {}};
  {
    const Stage stage(run.stages, "converged", 0);
    SolverSettings settings = base;
    settings.source = SourceModel::photon_map;
    settings.method = Method::automatic;
    settings.tolerance *= converged_tolerance;
    settings.photons *= converged_photons;
    c.converged = run_model(prepared, settings, seed + converged_seed, true, run);
    by.surface = at_checks(c.converged, prepared, checks, seed, run.workers);
    by.inside = inner_U_d(c.converged, object, c.truth.centers, c.truth.U_ri, run.workers);
    by.luminance = luminance_map(*c.converged.picture, seen);
    c.converged_error = first_channel(c.converged, object).error_estimate;
    c.converged_surface = seen_U_d(c.converged, prepared, seen, seed, run.workers);
    c.converged_lines = along_lines(c.converged, object, c, run.workers);
    c.diffusion_itself = measure(c.converged, prepared, object, by, c, run);
  }

  const double beneath = 1.0 / c.sigma_tr;
  c.slice = choose_slice(prepared.scene.objects[index], prepared.scene.camera,
                         c.lines[0].start + beneath * c.lines[0].inward);
  for (const SourceModel model : all_models) {
    Stage stage(run.stages, name_of(model), 2 + photon_shares.size());
    ComparedModel compared;
    SolverSettings settings = base;
    settings.source = model;
    compared.run = run_model(prepared, settings, seed, true, run);
    stage.advance();
    if (compared.run.ran()) {
      compared.errors = measure(compared.run, prepared, object, by, c, run);
      compared.lines = along_lines(compared.run, object, c, run.workers);
      compared.surface = relative_difference(
          seen_U_d(compared.run, prepared, seen, seed, run.workers), c.converged_surface);
      compared.picture =
          relative_difference(luminance_map(*compared.run.picture, seen), by.luminance);
      compared.errors.picture = rms(compared.picture);
      compared.slice = slice_of(model, prepared, object, c.slice, run);
      stage.advance();
      if (options.budgets) compared.budgets = sweep_budgets(prepared, settings, by, run, stage);
    }
    c.models.push_back(std::move(compared));
  }
  return c;
}

Report compare_scene(const std::string& path, const std::string& folder,
                     const CompareOptions& options, RunContext& run, Scene& scene_out) {
  const std::filesystem::path target(folder);
  make_output_folder(folder);
  const Comparison c = compare_models(path, options, run, scene_out);
  const Stage stage(run.stages, "write", 0);
  write_tables(c, target);
  write_text_file((target / "index.html").string(), compare_page(c));
  const ModelRun& judged = c.models.front().run;
  if (!judged.ran()) throw InputError(path + ": " + judged.cannot);
  return judged.solved->report;
}

}  // namespace knotlight
