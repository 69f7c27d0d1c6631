// The `chart` command: error against seconds for every method and setting.
#pragma once

#include <string>
#include <vector>

#include "pipeline/run_options.h"

namespace knotlight {

struct ChartOptions {
  double budget = 900.0;  // seconds on the wall per scene, of settings; the truth comes on top
  int levels = 5;         // settings per line, each finer than the one before
  int repeats = 2;
  double noise = 0.006;  // of path tracing's blocks

  // A few settings per line, of a truth that is hardly one: seconds.
  static ChartOptions quick() { return {30.0, 2, 2, 0.03}; }
};

// Measures every setting (contender.h) on the scenes and writes tables and pages to `folder`, a
// folder per scene if there are several. What a folder holds already is not measured again: an
// interrupted run goes on. Throws InputError if it holds measurements of another scene.
void chart_scenes(const std::vector<std::string>& paths, const std::string& folder,
                  const ChartOptions& options, RunContext& run);

}  // namespace knotlight
