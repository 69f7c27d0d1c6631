#include "chart/yardstick.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/clock.h"
#include "core/errors.h"
#include "core/file_io.h"
#include "core/not_finite.h"
#include "pipeline/glow.h"
#include "pipeline/plan.h"
#include "reference/path_film.h"
#include "report/csv.h"

namespace knotlight {
namespace {

namespace fs = std::filesystem;

// The judges have seeds of their own.
constexpr std::uint64_t truth_seed = 5'000'011, converged_seed = 6'000'013;
constexpr double seconds_between_checkpoints = 10.0;  // what an interruption costs at most

double relative_noise_of(const PictureBlocks::Judged& judged) {
  return judged.errors.norm() / std::sqrt(static_cast<double>(judged.errors.size())) /
         judged.means.mean();
}

// Twice as many samples until the noise is there, but no more than it needs.
PathFilm trace_truth(const PreparedScene& prepared, const PictureBlocks& blocks, double noise,
                     const std::string& file, RunContext& run) {
  const std::uint64_t seed = run.options.seed + truth_seed;
  const std::uint64_t key = samples_key(prepared.scene, seed);
  const PathTracer tracer(prepared.scene, *prepared.caster);
  PathFilm film(prepared.scene.camera);
  if (fs::exists(file)) film = read_film(file, prepared.scene.camera, key);
  Stage stage(run.stages, "path tracing", 0);
  Clock::time_point checkpoint = Clock::now();
  while (true) {
    std::uint64_t missing = 4;
    if (film.samples > 1) {
      const double now = relative_noise_of(blocks.means(film));
      if (now <= noise) break;
      const auto samples = static_cast<double>(film.samples);
      missing = static_cast<std::uint64_t>(
          std::ceil(samples * std::min(1.0, 1.02 * (now * now / (noise * noise) - 1.0) + 0.01)));
    }
    // One at a time: a sample per pixel takes about a second.
    for (std::uint64_t i = 0; i < missing; ++i) {
      add_samples(film, tracer, prepared.scene.camera, seed, 1, run.workers, stage);
      if (seconds_since(checkpoint) < seconds_between_checkpoints) continue;
      write_film(file, film, key);
      checkpoint = Clock::now();
    }
  }
  write_film(file, film, key);
  return film;
}

constexpr const char* field_kind = "field";
constexpr const char* picture_kind = "picture";
constexpr const char* doubt_kind = "doubt";

std::map<std::string, Converged> read_models(const std::string& file) {
  std::map<std::string, Converged> models;
  if (!fs::exists(file)) return models;
  for (const std::vector<std::string>& row : read_csv(file)) {
    if (row.size() < 2)
      throw InputError(file + ": a row has no name, expected model, kind, values");
    if (row[1] == doubt_kind) {
      models[row[0]].doubt = row.back();
      continue;
    }
    Eigen::VectorXd values(static_cast<Eigen::Index>(row.size() - 2));
    for (std::size_t i = 2; i < row.size(); ++i)
      values[static_cast<Eigen::Index>(i - 2)] = std::stod(row[i]);
    (row[1] == field_kind ? models[row[0]].field : models[row[0]].picture) = std::move(values);
  }
  return models;
}

std::vector<std::string> row_of(const std::string& model, const char* kind,
                                const Eigen::VectorXd& values) {
  std::vector<std::string> row = {model, kind};
  for (const double value : values) row.push_back(csv_number(value));
  return row;
}

void write_models(const std::string& file, const std::map<std::string, Converged>& models) {
  std::string text;
  for (const auto& [name, converged] : models) {
    text += csv_line(row_of(name, field_kind, converged.field));
    text += csv_line(row_of(name, picture_kind, converged.picture));
    if (!converged.doubt.empty()) text += csv_line({name, doubt_kind, converged.doubt});
  }
  write_text_file(file, text);
}

}  // namespace

const Eigen::VectorXd& Yardstick::field() const {
  SolverSettings settings;
  settings.source = SourceModel::photon_map;
  settings.diffusion = Diffusion::p1;
  return models.at(model_of(settings)).field;
}

std::string model_of(SolverSettings settings) {
  if (settings.source == SourceModel::irradiance_thesis) return "";
  choose_for_picture(settings);
  const Diffusion diffusion = settings.diffusion.value_or(Diffusion::p1);
  return fmt::format("{} {} {}", settings.source ? name_of(*settings.source) : "chosen",
                     name_of(chosen_exitance(settings)),
                     diffusion == Diffusion::p1           ? "p1"
                     : diffusion == Diffusion::asymptotic ? "asymptotic"
                                                          : "grosjean");
}

std::string points_csv(const Yardstick& by) {
  std::vector<std::vector<std::string>> rows;
  Eigen::Index at = 0;
  for (const SurfaceSamples& points : by.checks.objects)
    for (Eigen::Index i = 0; i < points.positions.cols(); ++i, ++at) {
      std::vector<std::string> row;
      for (const double x : points.positions.col(i)) row.push_back(csv_number(x));
      row.push_back(csv_number(by.checks.areas[at]));
      row.push_back(csv_number(by.field().size() > 0 ? by.field()[at] : nan));
      rows.push_back(std::move(row));
    }
  return csv_text({"x", "y", "z", "area", "U_d"}, rows);
}

Yardstick make_yardstick(PreparedScene& prepared, const std::vector<SolverSettings>& settings,
                         const ConvergedSettings& converged, double noise,
                         const std::string& folder, RunContext& run) {
  Yardstick by{surface_checks(prepared, run.options.seed), PictureBlocks(prepared), {}, 0, 0, {}};
  if (by.blocks.empty())
    throw InputError(
        "camera.resolution: no block of 8 x 8 pixels lies wholly on a translucent object, expected "
        "a picture that shows one large enough");
  const PathFilm film = trace_truth(prepared, by.blocks, noise,
                                    (fs::path(folder) / "path_tracing.film").string(), run);
  write_image((fs::path(folder) / "path_tracing.png").string(), film_image(film), {});
  by.truth = by.blocks.means(film);
  by.truth_noise = relative_noise_of(by.truth);
  by.truth_seconds = film.cpu_seconds;

  const std::string file = (fs::path(folder) / "converged.csv").string();
  by.models = read_models(file);
  std::vector<SolverSettings> wanted = {prepared.scene.solver};
  wanted.front().source = SourceModel::photon_map;
  wanted.front().exitance.reset();
  wanted.front().diffusion = Diffusion::p1;
  wanted.insert(wanted.end(), settings.begin(), settings.end());
  Stage stage(run.stages, "converged", wanted.size());
  for (SolverSettings own : wanted) {
    stage.advance();
    const std::string model = model_of(own);
    if (model.empty() || by.models.count(model) > 0) continue;
    choose_for_picture(own);
    own.photons_at_most = false;
    own.method = Method::automatic;
    own.tolerance = converged.tolerance;
    own.photons = converged.photons;
    own.irradiance_samples = converged.irradiance_samples;
    own.knots.reset();
    const ModelRun one = run_model(prepared, own, run.options.seed + converged_seed, true, run);
    Converged& result = by.models[model];
    result.doubt = one.cannot;
    if (one.ran()) {
      if (!one.solved->report.failures.empty()) result.doubt = one.solved->report.failures.front();
      if (own.diffusion.value_or(Diffusion::p1) == Diffusion::p1)
        result.field = at_checks(one, prepared, by.checks, run.options.seed, run.workers);
      result.picture = by.blocks.means(*one.picture);
    }
    write_models(file, by.models);
  }
  return by;
}

}  // namespace knotlight
