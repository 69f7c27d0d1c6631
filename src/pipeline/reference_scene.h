// The `reference` command: the same picture by Monte Carlo volume path tracing, without diffusion.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/run_options.h"

namespace knotlight {

// What the picture has cost, and how good it is.
struct ReferenceSummary {
  std::uint64_t samples = 0;          // per pixel
  std::uint64_t resumed_samples = 0;  // of those, taken before this run
  double cpu_seconds = 0.0;           // of all samples, by all threads
  double noise = 0.0;                 // per pixel, relative (relative_noise)
  double unfound_share = 0.0;         // of the light of lamps without size (unfound_light.h)

  // Checks that failed, one sentence each; empty: the picture can be trusted.
  std::vector<std::string> failures() const;

  // Of a picture with 1 % noise per pixel; noise falls as samples^(-1/2).
  double samples_for_1_percent() const { return static_cast<double>(samples) * effort(); }
  double cpu_seconds_for_1_percent() const { return cpu_seconds * effort(); }

 private:
  double effort() const { return noise * noise * 1e4; }
};

// Writes the picture to each of `outputs` (.exr with its variance, .png tone-mapped). `spp`:
// samples per pixel, in place of camera.samples. Every ten seconds the samples so far are kept in
// `outputs.front()`.part; a run of the same scene and seed goes on from there, and it is removed in
// the end. Throws InputError for a .part file of another scene, seed or version,
// and for lamps that cannot be found.
ReferenceSummary reference_scene(const std::string& path, const std::vector<std::string>& outputs,
                                 std::optional<std::uint64_t> spp, RunContext& run);

// Two lines for people.
std::string describe(const ReferenceSummary& summary);
// The summary that --json writes; keys: docs/reference.md.
std::string reference_json(const ReferenceSummary& summary, const RunContext& run);

}  // namespace knotlight
