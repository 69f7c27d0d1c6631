// What every command takes beside its scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"

namespace knotlight {

struct RunOptions {
  std::vector<std::string> overrides;  // "path.to.key=value"
  std::uint64_t seed = 1;
  int threads = 0;  // 0 = one per core
  bool quiet = false;
  std::string json;  // file for the summary; empty = none
};

// What a running command carries along.
struct RunContext {
  RunOptions options;
  Workers workers;
  Stages stages;

  RunContext(const RunOptions& o, bool bars) : options(o), workers(o.threads), stages(bars) {}
};

}  // namespace knotlight
