// The `compare` command: source models side by side on one scene, as a page and as tables.
#pragma once

#include <optional>
#include <string>

#include "compare/figures.h"
#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "scene/scene.h"

namespace knotlight {

struct CompareOptions {
  // Rays of photon_map per channel, in place of solver.photons. Left out: as many as bring the
  // noise near the tolerance, at most the scene's, since a comparison solves the scene some twenty
  // times. The converged solution takes four times as many.
  std::optional<std::size_t> photons;
  // Of the photons of all orders that tell the truth: 1 % of standard error in the bright cells of
  // scenes/knot.yaml in some ten seconds on two cores.
  double interactions = 4e7;
  bool budgets = true;  // the chart of error against time, half of all the work
};

// Runs every source model on the scene, and what they are measured against.
Comparison compare_models(const std::string& path, const CompareOptions& options, RunContext& run,
                          Scene& scene_out);

// The same, written to `folder` (made if it is not there) as index.html, compare.csv (a row per
// model), lines.csv (fields along lines) and budgets.csv (error against time). The report is
// photon_map's.
Report compare_scene(const std::string& path, const std::string& folder,
                     const CompareOptions& options, RunContext& run, Scene& scene_out);

}  // namespace knotlight
