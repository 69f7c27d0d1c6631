#include "pipeline/reference_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/clock.h"
#include "core/errors.h"
#include "core/image_io.h"
#include "pipeline/picture_metadata.h"
#include "pipeline/scene_setup.h"
#include "reference/path_film.h"
#include "reference/path_tracer.h"
#include "reference/unfound_light.h"

namespace knotlight {
namespace {

constexpr double seconds_between_checkpoints = 10.0;  // what an interruption costs at most
// A pass shorter than this is made longer next time: checkpoints are possible between passes only.
constexpr double seconds_per_pass = 2.0;

// More of the lamps' light than this going other ways than can be followed makes the picture wrong
// by more than references are asked for.
constexpr double tolerated_unfound_share = 0.01;

// Passes until the film has `wanted` samples, with checkpoints in `part`.
void fill(PathFilm& film, std::uint64_t wanted, const PreparedScene& prepared, std::uint64_t key,
          const std::string& part, RunContext& run) {
  const PathTracer tracer(prepared.scene, *prepared.caster);
  const std::uint64_t missing = wanted - std::min(wanted, film.samples);
  Stage stage(run.stages, "samples", missing * film.sum.size());
  Clock::time_point checkpoint = Clock::now();
  std::uint64_t pass = 1;
  while (film.samples < wanted) {
    const Clock::time_point start = Clock::now();
    add_samples(film, tracer, prepared.scene.camera, run.options.seed,
                std::min(pass, wanted - film.samples), run.workers, stage);
    if (seconds_since(start) < seconds_per_pass) pass *= 2;
    if (film.samples < wanted && seconds_since(checkpoint) >= seconds_between_checkpoints) {
      write_film(part, film, key);
      checkpoint = Clock::now();
    }
  }
}

Metadata reference_metadata(const Scene& scene, const std::string& path,
                            const ReferenceSummary& summary, const RunContext& run) {
  Metadata metadata = picture_metadata(scene, path, summary.failures(), run);
  metadata.insert(metadata.end(), {{"knotlight:method", "volume path tracing"},
                                   {"knotlight:variance", "of the mean over independent samples"},
                                   {"knotlight:samples", fmt::format("{}", summary.samples)},
                                   {"knotlight:noise", fmt::format("{:.4g}", summary.noise)}});
  return metadata;
}

}  // namespace

ReferenceSummary reference_scene(const std::string& path, const std::vector<std::string>& outputs,
                                 std::optional<std::uint64_t> spp, RunContext& run) {
  const PreparedScene prepared = prepare_scene(path, run);
  const Scene& scene = prepared.scene;
  try {
    refuse_unfindable_lights(scene);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
  const std::uint64_t key = samples_key(scene, run.options.seed);
  const std::string part = outputs.front() + ".part";
  ReferenceSummary summary;
  summary.unfound_share = unfound_share(scene, *prepared.caster, run.options.seed);
  PathFilm film(scene.camera);
  if (std::filesystem::exists(part)) {
    film = read_film(part, scene.camera, key);
    summary.resumed_samples = film.samples;
    if (!run.options.quiet)
      fmt::print(stderr, "{}: going on from {} samples per pixel\n", part, film.samples);
  }
  const auto wanted = spp.value_or(static_cast<std::uint64_t>(scene.camera.samples));
  fill(film, wanted, prepared, key, part, run);
  summary.samples = film.samples;
  summary.cpu_seconds = film.cpu_seconds;
  summary.noise = relative_noise(film);

  const Stage stage(run.stages, "write", 0);
  const Metadata metadata = reference_metadata(scene, path, summary, run);
  for (const std::string& output : outputs) {
    if (std::filesystem::path(output).extension() == ".exr")
      write_layers(output, film.width, film.height, film_layers(film), metadata);
    else
      write_image(output, film_image(film), metadata);
  }
  std::filesystem::remove(part);
  return summary;
}

std::vector<std::string> ReferenceSummary::failures() const {
  if (unfound_share <= tolerated_unfound_share) return {};
  return {
      fmt::format("{:.2g} % of the light of point lights and beams is mirrored or refracted on "
                  "ways that are not followed (docs/reference.md); small area lights have it "
                  "all",
                  100.0 * unfound_share)};
}

std::string describe(const ReferenceSummary& s) {
  std::string text = fmt::format("{} samples per pixel, {:.1f} CPU s", s.samples, s.cpu_seconds);
  if (s.samples < 2) return text + "; noise is known from 2 samples on\n";
  text +=
      fmt::format(": {:.2g} % noise per pixel (rms standard error over mean)\n", 100.0 * s.noise);
  if (s.noise > 0.0)
    text += fmt::format("1 % noise per pixel would take about {:.0f} samples, {:.3g} CPU s\n",
                        std::ceil(s.samples_for_1_percent()), s.cpu_seconds_for_1_percent());
  return text;
}

std::string reference_json(const ReferenceSummary& summary, const RunContext& run) {
  nlohmann::ordered_json json;
  json["program"] = "knotlight " KNOTLIGHT_VERSION;
  json["command"] = "reference";
  json["seed"] = run.options.seed;
  json["threads"] = run.workers.threads();
  json["samples"] = summary.samples;
  json["resumed_samples"] = summary.resumed_samples;
  json["cpu_seconds_of_samples"] = summary.cpu_seconds;
  json["noise"] = summary.noise;
  json["unfound_share"] = summary.unfound_share;
  json["samples_for_1_percent"] = summary.samples_for_1_percent();
  json["cpu_seconds_for_1_percent"] = summary.cpu_seconds_for_1_percent();
  json["trusted"] = summary.failures().empty();
  json["failures"] = summary.failures();
  nlohmann::ordered_json seconds;
  for (const auto& [name, value] : run.stages.seconds()) seconds[name] = value;
  json["seconds"] = seconds;
  return json.dump(2) + "\n";
}

}  // namespace knotlight
