#include "compare/models.h"

#include <functional>

#include "core/clock.h"
#include "core/errors.h"
#include "core/memory_peak.h"
#include "pipeline/render_scene.h"

namespace knotlight {
namespace {

constexpr std::size_t points_per_chunk = 512;

double seconds_of(const Stages& stages, const std::string& name) {
  double sum = 0.0;
  for (const auto& [stage, seconds] : stages.seconds())
    if (stage == name) sum += seconds;
  return sum;
}

// n values, made chunk by chunk: part(chunk, first, count) gives those from `first` on.
Eigen::VectorXd in_chunks(
    Eigen::Index n, const Workers& workers,
    const std::function<Eigen::VectorXd(std::size_t, Eigen::Index, Eigen::Index)>& part) {
  Eigen::VectorXd values(n);
  workers.for_chunks(static_cast<std::size_t>(n), points_per_chunk,
                     [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                       const auto first = static_cast<Eigen::Index>(begin);
                       const auto count = static_cast<Eigen::Index>(end - begin);
                       values.segment(first, count) = part(chunk, first, count);
                     });
  return values;
}

}  // namespace

ModelRun run_model(PreparedScene& prepared, const SolverSettings& settings, std::uint64_t seed,
                   bool picture, const RunContext& run) {
  ModelRun result;
  result.model = settings.source.value_or(SourceModel::photon_map);
  const SolverSettings own = prepared.scene.solver;
  prepared.scene.solver = settings;
  RunOptions options = run.options;
  options.seed = seed;
  RunContext solving(options, false);
  RunContext seeing(run.options, false);
  const MemoryPeak memory;
  try {
    const double start = cpu_seconds();
    result.solved = solve_scene(prepared, solving);
    result.cost.cpu = cpu_seconds() - start;
    result.model = result.solved->plan.source;
    if (picture) result.picture = take_picture(prepared, *result.solved, seeing);
    result.cost.picture_cpu = cpu_seconds() - start - result.cost.cpu;
  } catch (const InputError& error) {
    result.cannot = error.what();
  }
  prepared.scene.solver = own;
  result.cost.memory = memory.MiB();
  result.cost.light = seconds_of(solving.stages, "photons");
  result.cost.grid = seconds_of(solving.stages, "grid");
  result.cost.solve = seconds_of(solving.stages, "solve");
  result.cost.picture = seconds_of(seeing.stages, "surface") + seconds_of(seeing.stages, "picture");
  return result;
}

Eigen::VectorXd surface_U_d(const ModelRun& run, const PreparedScene& prepared, std::size_t object,
                            const Points& positions, const Points& normals, std::uint64_t seed,
                            const Workers& workers) {
  const SolvedChannel& channel = run.solved->objects[object].front();
  return in_chunks(
      positions.cols(), workers, [&](std::size_t chunk, Eigen::Index first, Eigen::Index count) {
        return leaving_U_d(channel, prepared.scene, *prepared.caster, prepared.translucent[object],
                           0, positions.middleCols(first, count), normals.middleCols(first, count),
                           seed + chunk);
      });
}

Eigen::VectorXd inner_U_d(const ModelRun& run, std::size_t object, const Points& positions,
                          const Eigen::VectorXd& U_ri, const Workers& workers) {
  const SolvedChannel& channel = run.solved->objects[object].front();
  const Eigen::VectorXd values = in_chunks(
      positions.cols(), workers, [&](std::size_t, Eigen::Index first, Eigen::Index count) {
        return channel.U_d(positions.middleCols(first, count));
      });
  return channel.model == SourceModel::boundary_flux ? Eigen::VectorXd(values - U_ri) : values;
}

}  // namespace knotlight
