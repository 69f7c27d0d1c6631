#include "stability/stability.h"

#include <algorithm>
#include <array>

#include "stability/studies.h"

namespace knotlight {
namespace {

constexpr std::array methods{Method::bkm_thesis, Method::bkm,  Method::mfs,
                             Method::lbkm,       Method::grid, Method::automatic};

}  // namespace

std::size_t Stability::broken() const {
  return static_cast<std::size_t>(std::count_if(
      extremes.begin(), extremes.end(), [](const auto& trial) { return trial.breaks_the_rule(); }));
}

// Jobs run side by side, each on one thread.
Stability stability(const StabilityOptions& options, RunContext& run) {
  Stability result;
  {
    const std::vector<StudyJob> jobs = study_jobs(options.quick, run.options.seed);
    std::vector<std::vector<Trial>> done(jobs.size());
    Stage stage(run.stages, "maps", jobs.size());
    run.workers.for_chunks(jobs.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
      done[i] = jobs[i]();
      stage.advance();
    });
    for (const std::vector<Trial>& trials : done)
      result.trials.insert(result.trials.end(), trials.begin(), trials.end());
  }
  result.scenes = extreme_scenes(options.quick);
  std::vector<SurfaceTruth> truths(result.scenes.size());
  {
    Stage stage(run.stages, "references", truths.size());
    run.workers.for_chunks(truths.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
      truths[i] = truth_of(result.scenes[i], run.options.seed);
      stage.advance();
    });
  }
  result.extremes.resize(result.scenes.size() * methods.size());
  Stage stage(run.stages, "scenes", result.extremes.size());
  run.workers.for_chunks(result.extremes.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    const std::size_t scene = i / methods.size();
    result.extremes[i] = try_extreme(result.scenes[scene], methods[i % methods.size()],
                                     truths[scene], run.options.seed);
    stage.advance();
  });
  return result;
}

}  // namespace knotlight
