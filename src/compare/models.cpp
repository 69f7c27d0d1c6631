#include "compare/models.h"

#include <malloc.h>

#include <fstream>
#include <functional>
#include <limits>

#include "core/errors.h"
#include "pipeline/render_scene.h"

namespace knotlight {
namespace {

constexpr std::size_t points_per_chunk = 512;

// A line of /proc/self/status such as "VmHWM:  1234 kB", in MiB; NaN if there is none.
double status_MiB(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  return std::numeric_limits<double>::quiet_NaN();
}

// Peak memory from here on. The peak that the system keeps belongs to the whole process; it is set
// back to what is in use now (Linux: "5" into clear_refs).
class MemoryPeak {
 public:
  MemoryPeak() {
    malloc_trim(0);  // what earlier runs freed is not in use
    std::ofstream reset("/proc/self/clear_refs");
    reset << "5" << std::flush;
    before_ = reset ? status_MiB("VmRSS") : std::numeric_limits<double>::quiet_NaN();
  }
  double MiB() const { return status_MiB("VmHWM") - before_; }

 private:
  double before_;
};

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
  result.model = settings.source.value();
  const SolverSettings own = prepared.scene.solver;
  prepared.scene.solver = settings;
  RunOptions options = run.options;
  options.seed = seed;
  RunContext solving(options, false);
  RunContext seeing(run.options, false);
  const MemoryPeak memory;
  try {
    result.solved = solve_scene(prepared, solving);
    if (picture) result.picture = take_picture(prepared, *result.solved, seeing);
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
