// A scene solved as every command solves it, with the time it took.
#pragma once

#include <cstdint>
#include <utility>

#include "core/clock.h"
#include "pipeline/solve_scene.h"

namespace knotlight {

struct TimedSolution {
  SolvedScene solved;
  double seconds;  // CPU, of all threads
};

inline TimedSolution timed_solve(Scene scene, std::uint64_t seed, int threads) {
  RunOptions options;
  options.seed = seed;
  options.threads = threads;
  options.quiet = true;
  RunContext run(options, false);
  const double start = cpu_seconds();
  SolvedScene solved = solve_scene(prepare_scene(std::move(scene)), run);
  return {std::move(solved), cpu_seconds() - start};
}

}  // namespace knotlight
