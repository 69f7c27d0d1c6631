#include "chart/measure.h"

#include <algorithm>
#include <cmath>

#include "chart/error_parts.h"
#include "core/clock.h"
#include "core/errors.h"
#include "core/memory_peak.h"
#include "pipeline/glow.h"
#include "rivals/dipole_picture.h"

namespace knotlight {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// One repeat.
struct Outcome {
  std::string failed;
  double field_seconds = unknown, picture_seconds = unknown, wall_seconds = unknown;
  double memory = unknown, estimate = unknown;
  Eigen::VectorXd field;    // U_d at the checks; empty: has none
  Eigen::VectorXd picture;  // block means; empty: has none
};

Outcome run_solver(const Contender& contender, PreparedScene& prepared, const Yardstick& by,
                   const RunContext& run) {
  SolverSettings settings = contender.solver;
  choose_for_picture(settings);
  const auto start = Clock::now();
  const ModelRun one = run_model(prepared, settings, run.options.seed, true, run);
  Outcome result;
  result.wall_seconds = seconds_since(start);
  if (!one.ran()) {
    result.failed = one.cannot;
    return result;
  }
  const Report& report = one.solved->report;
  if (!report.failures.empty()) result.failed = report.failures.front();
  result.field_seconds = one.cost.cpu;
  result.picture_seconds = one.cost.cpu + one.cost.picture_cpu;
  result.memory = one.cost.memory;
  result.estimate = 0.0;
  for (const ObjectReport& object : report.objects)
    for (const ChannelReport& channel : object.channels)
      result.estimate = std::max(result.estimate, channel.error_estimate);
  if (settings.diffusion.value_or(Diffusion::p1) == Diffusion::p1)
    result.field = at_checks(one, prepared, by.checks, run.options.seed, run.workers);
  result.picture = by.blocks.means(*one.picture);
  return result;
}

Outcome run_dipole(const Contender& contender, const PreparedScene& prepared, const Yardstick& by,
                   RunContext& run) {
  DipoleSettings settings;
  settings.samples_per_square = contender.entries;
  settings.form = contender.form;
  Outcome result;
  double start = cpu_seconds();
  result.field.resize(by.checks.areas.size());
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < by.checks.objects.size(); ++i) {
    const DipoleSolution solution(prepared.scene, *prepared.caster, prepared.translucent[i], 0,
                                  settings, run.options.seed, run.workers);
    const Points& points = by.checks.objects[i].positions;
    result.field.segment(first, points.cols()) = solution.mean_intensities(points, run.workers);
    first += points.cols();
  }
  result.field_seconds = cpu_seconds() - start;
  const MemoryPeak memory;
  const auto wall = Clock::now();
  start = cpu_seconds();
  const Image picture = dipole_picture(prepared, settings, run);
  result.picture_seconds = cpu_seconds() - start;
  result.wall_seconds = seconds_since(wall);
  result.memory = memory.MiB();
  result.picture = by.blocks.means(picture);
  return result;
}

Outcome run_reference(const Contender& contender, const PreparedScene& prepared,
                      const Yardstick& by, RunContext& run) {
  Outcome result;
  const MemoryPeak memory;
  const auto wall = Clock::now();
  const PathTracer tracer(prepared.scene, *prepared.caster);
  PathFilm film(prepared.scene.camera);
  Stage stage(run.stages, "samples", contender.samples * film.sum.size());
  add_samples(film, tracer, prepared.scene.camera, run.options.seed, contender.samples, run.workers,
              stage);
  result.picture_seconds = film.cpu_seconds;
  result.wall_seconds = seconds_since(wall);
  result.memory = memory.MiB();
  result.picture = by.blocks.means(film_image(film));
  return result;
}

Outcome run_once(const Contender& contender, PreparedScene& prepared, const Yardstick& by,
                 RunContext& run) {
  try {
    switch (contender.maker) {
      case Maker::solver:
        return run_solver(contender, prepared, by, run);
      case Maker::dipole:
        return run_dipole(contender, prepared, by, run);
      case Maker::reference:
        return run_reference(contender, prepared, by, run);
    }
  } catch (const InputError& error) {
    Outcome result;
    result.failed = error.what();
    return result;
  }
  return {};
}

}  // namespace

Measurement measure(const Contender& contender, PreparedScene& prepared, const Yardstick& by,
                    int repeats, const RunContext& run) {
  Measurement m;
  m.line = contender.line;
  m.setting = contender.setting;
  m.level = contender.level;
  std::vector<Eigen::VectorXd> fields, pictures;
  std::vector<Outcome> outcomes;
  for (int i = 0; i < repeats; ++i) {
    RunOptions options = run.options;
    options.seed += static_cast<std::uint64_t>(i);
    RunContext own(options, false);
    outcomes.push_back(run_once(contender, prepared, by, own));
    const Outcome& one = outcomes.back();
    if (m.failed.empty()) m.failed = one.failed;
    if (one.field.size() > 0) fields.push_back(one.field);
    if (one.picture.size() > 0) pictures.push_back(one.picture);
    if (one.field.size() == 0 && one.picture.size() == 0) break;  // nor would the next
  }
  const auto mean = [&](double Outcome::*value) {
    double sum = 0.0;
    for (const Outcome& one : outcomes) sum += one.*value;
    return sum / static_cast<double>(outcomes.size());
  };
  m.field_seconds = mean(&Outcome::field_seconds);
  m.picture_seconds = mean(&Outcome::picture_seconds);
  m.wall_seconds = mean(&Outcome::wall_seconds);
  m.memory = mean(&Outcome::memory);
  m.estimate = mean(&Outcome::estimate);
  Converged converged;
  if (contender.maker == Maker::solver)
    if (const auto found = by.models.find(model_of(contender.solver)); found != by.models.end())
      converged = found->second;
  m.field = error_parts(
      fields, by.field(), 0.0, converged.field,
      [&](const auto& a, const auto& b) { return relative_rms(a, b, by.checks.areas); });
  m.picture = error_parts(pictures, by.truth.means, by.truth_noise, converged.picture,
                          [](const auto& a, const auto& b) { return block_error(a, b); });
  return m;
}

}  // namespace knotlight
