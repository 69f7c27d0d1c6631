#include "chart/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "chart/front.h"
#include "chart/measure.h"
#include "chart/page.h"
#include "core/clock.h"
#include "core/errors.h"
#include "core/file_io.h"
#include "pipeline/scene_key.h"
#include "report/csv.h"
#include "scene/scene_hash.h"
#include "scene/scene_reader.h"

namespace knotlight {
namespace {

namespace fs = std::filesystem;

// The next level of a line may take so many times as long as the last.
constexpr double growth = 4.0;
// The converged runs, beside the finest level: cells of 0.6 times the size, half the noise.
constexpr double converged_tolerance = 0.4;
constexpr std::size_t converged_factor = 4;

// What the measurements in a folder belong to.
void check_key(const std::string& file, const PreparedScene& prepared, const RunContext& run,
               const ChartOptions& options) {
  std::vector<KeyPart> key = solution_key(prepared.scene, run.options.seed);
  key.push_back({"camera, lights, objects", samples_key(prepared.scene, run.options.seed)});
  key.push_back({"solver.exitance", SceneHash::of(prepared.scene.solver.exitance)});
  key.push_back({"the program's version", SceneHash::of(std::string(KNOTLIGHT_VERSION))});
  key.push_back({"noise", SceneHash::of(options.noise)});
  key.push_back({"levels", static_cast<std::uint64_t>(options.levels)});
  key.push_back({"repeats", static_cast<std::uint64_t>(options.repeats)});
  std::vector<std::vector<std::string>> rows;
  for (const KeyPart& part : key) rows.push_back({part.name, fmt::format("{}", part.value)});
  if (!fs::exists(file)) {
    write_text_file(file, csv_text({"part", "fingerprint"}, rows));
    return;
  }
  std::vector<KeyPart> before;
  for (const std::vector<std::string>& row : read_csv(file))
    if (row.size() == 2 && row[0] != "part") before.push_back({row[0], std::stoull(row[1])});
  if (const std::string other = first_difference(before, key); !other.empty())
    throw InputError(fmt::format(
        "{}: measurements there are of another scene or other options ({} differs), expected an "
        "empty folder or one to go on with",
        fs::path(file).parent_path().string(), other));
}

// Goes through the contenders in order while the budget lasts.
class Measuring {
 public:
  Measuring(std::string file, double budget, int repeats)
      : file_(std::move(file)), budget_(budget) {
    if (!fs::exists(file_)) return;
    measured_ = read_measurements(file_);
    for (const Measurement& m : measured_)
      if (std::isfinite(m.wall_seconds)) {
        last_[m.line] = repeats * m.wall_seconds;
        spent_ += repeats * m.wall_seconds;
      }
  }

  bool has(const Contender& contender) const {
    return std::any_of(measured_.begin(), measured_.end(),
                       [&](const Measurement& m) { return m.name() == contender.name(); });
  }
  // Whether there is time for it, by what the line took before. What was measured by an earlier run
  // in the folder counts.
  bool affords(const Contender& contender) const {
    const auto before = last_.find(contender.line);
    const double expected = before == last_.end() ? 0.0 : growth * before->second;
    return spent_ + seconds_since(start_) + expected <= budget_;
  }
  void add(const Measurement& m, double seconds) {
    measured_.push_back(m);
    last_[m.line] = seconds;
    write_text_file(file_, measurements_csv(measured_));
  }
  const std::vector<Measurement>& all() const { return measured_; }

 private:
  std::string file_;
  double budget_;
  double spent_ = 0.0;  // by earlier runs
  Clock::time_point start_ = Clock::now();
  std::map<std::string, double> last_;  // seconds of the last level of each line
  std::vector<Measurement> measured_;
};

ChartedScene chart_scene(const std::string& path, const std::string& folder,
                         const ChartOptions& options, RunContext& run) {
  PreparedScene prepared = prepare_scene(path, run);
  if (prepared.translucent.empty())
    throw InputError(path + ": objects: none is translucent, expected one to chart methods on");
  make_output_folder(folder);
  const auto in_folder = [&](const char* name) { return (fs::path(folder) / name).string(); };
  check_key(in_folder("key.csv"), prepared, run, options);

  const auto chosen = [&](double tolerance) {
    std::vector<std::string> overrides = run.options.overrides;
    overrides.push_back(fmt::format("solver.tolerance={}", tolerance));
    return read_scene(path, overrides).solver;
  };
  const std::vector<Contender> all = contenders(prepared.scene, chosen, options.levels);
  std::vector<SolverSettings> settings;
  ConvergedSettings converged{1.0, 0, 0};
  for (const Contender& contender : all) {
    if (contender.maker != Maker::solver) continue;
    settings.push_back(contender.solver);
    converged.tolerance = std::min(converged.tolerance, contender.solver.tolerance);
    if (contender.line == "grid")
      converged.photons = std::max(converged.photons, contender.solver.photons);
    converged.irradiance_samples =
        std::max(converged.irradiance_samples, contender.solver.irradiance_samples.value_or(0));
  }
  converged.tolerance *= converged_tolerance;
  converged.photons *= converged_factor;
  converged.irradiance_samples *= converged_factor;
  const Yardstick by = make_yardstick(prepared, settings, converged, options.noise, folder, run);

  ChartedScene result;
  result.name = fs::path(path).stem().string();
  result.path = path;
  result.truth_noise = by.truth_noise;
  result.truth_seconds = by.truth_seconds;
  result.repeats = options.repeats;
  for (const auto& [model, one] : by.models)
    if (!one.doubt.empty()) result.doubts.push_back(fmt::format("{}: {}", model, one.doubt));
  Measuring measuring(in_folder("measurements.csv"), options.budget, options.repeats);
  {
    Stage stage(run.stages, "settings", all.size());
    for (const Contender& contender : all) {
      if (!measuring.has(contender)) {
        if (measuring.affords(contender)) {
          const auto start = Clock::now();
          const Measurement m = measure(contender, prepared, by, options.repeats, run);
          measuring.add(m, seconds_since(start));
        } else {
          ++result.untried;
        }
      }
      stage.advance();
    }
  }
  result.measurements = measuring.all();
  write_text_file(in_folder("points.csv"), points_csv(by));
  if (const std::string file = in_folder("finite_elements.csv"); fs::exists(file))
    for (Measurement& m : read_measurements(file)) result.measurements.push_back(std::move(m));
  write_text_file(in_folder("index.html"), chart_page(result));
  for (const auto& [name, svg] : chart_svgs(result))
    write_text_file(in_folder((name + ".svg").c_str()),
                    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + svg);
  return result;
}

}  // namespace

void chart_scenes(const std::vector<std::string>& paths, const std::string& folder,
                  const ChartOptions& options, RunContext& run) {
  // A mistake in the last scene is to be told before the first has taken its time.
  for (const std::string& path : paths) read_scene(path, run.options.overrides);
  make_output_folder(folder);
  if (paths.size() == 1) {
    chart_scene(paths.front(), folder, options, run);
    return;
  }
  std::vector<ChartedScene> scenes;
  for (const std::string& path : paths) {
    const std::string own = (fs::path(folder) / fs::path(path).stem()).string();
    scenes.push_back(chart_scene(path, own, options, run));
    write_text_file((fs::path(folder) / "index.html").string(), chart_index(scenes));
    write_text_file((fs::path(folder) / "ratios.csv").string(), ratios_csv(scenes));
  }
}

}  // namespace knotlight
