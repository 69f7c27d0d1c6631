// The `stability` command: where each method fails, on exact boundary value problems and in scenes.
#pragma once

#include <string>
#include <vector>

#include "pipeline/run_options.h"
#include "stability/extremes.h"
#include "stability/trial.h"

namespace knotlight {

struct StabilityOptions {
  bool quick = false;  // a few cells of every map, two scenes; seconds
};

struct Stability {
  std::vector<Trial> trials;
  std::vector<ExtremeScene> scenes;
  std::vector<ExtremeTrial> extremes;  // scene by scene, in it method by method

  // Scenes and methods that break the rule of extremes.h.
  std::size_t broken() const;
};

// Same bits for any number of threads, seconds excepted.
Stability stability(const StabilityOptions& options, RunContext& run);

}  // namespace knotlight
