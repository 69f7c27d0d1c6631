// The command line. Commands live in src/pipeline; this file parses words and turns outcomes into
// exit codes.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>

#include "app/view_window.h"
#include "chart/chart.h"
#include "compare/compare.h"
#include "core/errors.h"
#include "core/file_io.h"
#include "core/image_io.h"
#include "pipeline/info.h"
#include "pipeline/layers.h"
#include "pipeline/probe_scene.h"
#include "pipeline/reference_scene.h"
#include "pipeline/render_scene.h"
#include "pipeline/report_json.h"
#include "pipeline/run_options.h"
#include "scene/nearest_name.h"
#include "stability/report.h"
#include "stability/stability.h"
#include "study/report.h"
#include "study/study.h"
#include "validate/report.h"
#include "validate/validate.h"

namespace knotlight {
namespace {

struct CommandLine {
  std::string scene;
  std::string output;
  std::string points;
  std::optional<std::string> layers;
  std::string solution, save_solution;
  bool json_wanted = false;
  std::optional<std::uint64_t> samples;
  std::vector<std::string> scenes;
  ChartOptions chart;
  bool quick_chart = false;
  CompareOptions compare;
  ValidateOptions validate;
  StabilityOptions stability;
  std::string study, markdown;
  StudyOptions studies;
  RunOptions options;
};

void add_run_options(CLI::App& command, CommandLine& line) {
  command.add_option("--seed", line.options.seed, "seed of all random numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--threads", line.options.threads, "threads; 0 = one per core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_flag("--quiet", line.options.quiet, "print nothing but errors");
}

void add_common_options(CLI::App& command, CommandLine& line) {
  command.add_option("scene", line.scene, "scene file (YAML)")->required();
  command.add_option("--set", line.options.overrides, "override a scene key: path.to.key=value")
      ->allow_extra_args(false)
      ->take_all();
  add_run_options(command, line);
}

// Without -o a picture goes to the working folder under the scene's name, as .exr to measure and as
// .png to look at.
std::vector<std::string> picture_files(const CommandLine& line, const std::string& ending = "") {
  if (!line.output.empty()) return {line.output};
  const std::string stem = std::filesystem::path(line.scene).stem().string() + ending;
  return {stem + ".exr", stem + ".png"};
}

// Failed checks, one line each; tells the exit code.
int judge(const std::vector<std::string>& failures) {
  for (const std::string& failure : failures)
    fmt::print(stderr, "not to be trusted: {}\n", failure);
  return failures.empty() ? exit_ok : exit_untrusted;
}

void write_summary(const CommandLine& line, const std::string& command, const Report& report,
                   const Scene& scene, const RunContext& run) {
  if (!line.options.json.empty())
    write_text_file(line.options.json, report_json(command, report, scene, run));
}

// Before the work starts, not after it.
void check_folder_of(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder))
    throw InputError(
        fmt::format("{}: its folder does not exist, expected a place to write to", file));
}

int render(const CommandLine& line, RunContext& run) {
  RenderFiles files;
  files.pictures = picture_files(line);
  for (const std::string& file : files.pictures) {
    check_image_extension(file);
    check_folder_of(file);
  }
  if (line.layers) {
    files.layers = chosen_layers(*line.layers);
    if (std::none_of(files.pictures.begin(), files.pictures.end(), holds_layers))
      throw InputError(fmt::format("--layers: {} cannot hold layers, expected an .exr (-o)",
                                   files.pictures.front()));
  }
  files.solution = line.solution;
  files.save_solution = line.save_solution;
  if (!files.solution.empty() && !files.save_solution.empty())
    throw InputError("--save-solution: would copy the file of --solution, expected one of the two");
  if (!files.save_solution.empty()) check_folder_of(files.save_solution);
  Scene scene;
  const Report report = render_scene(line.scene, files, run, scene);
  write_summary(line, "render", report, scene, run);
  if (!line.options.quiet)
    for (const std::string& file : files.pictures) fmt::print("{}\n", file);
  return judge(report.failures);
}

int reference(const CommandLine& line, RunContext& run) {
  const std::vector<std::string> files = picture_files(line, "_reference");
  for (const std::string& file : files) {
    check_image_extension(file);
    check_folder_of(file);
  }
  const ReferenceSummary summary = reference_scene(line.scene, files, line.samples, run);
  if (!line.options.json.empty()) write_text_file(line.options.json, reference_json(summary, run));
  if (!line.options.quiet) fmt::print("{}\n{}", fmt::join(files, "\n"), describe(summary));
  return judge(summary.failures());
}

int probe(const CommandLine& line, RunContext& run) {
  check_folder_of(line.output);
  Scene scene;
  const Report report = probe_scene(line.scene, line.points, line.output, run, scene);
  write_summary(line, "probe", report, scene, run);
  return judge(report.failures);
}

// The scenes whose table is in docs/results, seen from the top folder of the repository.
const std::vector<std::string> charted_scenes = {
    "scenes/pictures/sphere.yaml", "scenes/pictures/torus.yaml", "scenes/pictures/plate.yaml",
    "scenes/pictures/bunny.yaml"};

int chart(const CommandLine& line, RunContext& run) {
  const std::vector<std::string>& scenes = line.scenes.empty() ? charted_scenes : line.scenes;
  chart_scenes(scenes, line.output, line.quick_chart ? ChartOptions::quick() : line.chart, run);
  if (!line.options.quiet) fmt::print("{}/index.html\n", line.output);
  return exit_ok;
}

int compare(const CommandLine& line, RunContext& run) {
  Scene scene;
  const Report report = compare_scene(line.scene, line.output, line.compare, run, scene);
  write_summary(line, "compare", report, scene, run);
  if (!line.options.quiet)
    fmt::print("{}\n", (std::filesystem::path(line.output) / "index.html").string());
  return judge(report.failures);
}

int view(const CommandLine& line) {
  view_scene(line.scene, line.options);
  return exit_ok;
}

int info(const CommandLine& line, RunContext& run) {
  Scene scene;
  const Report report = inspect_scene(line.scene, line.json_wanted, run, scene);
  if (line.json_wanted && line.options.json.empty())
    fmt::print("{}", report_json("info", report, scene, run));
  else if (!line.options.quiet)
    fmt::print("{}", describe(report, scene));
  write_summary(line, "info", report, scene, run);
  return exit_ok;
}

int validate_program(const CommandLine& line, RunContext& run) {
  if (!line.output.empty()) make_output_folder(line.output);
  const Validation validation = validate(line.validate, run);
  if (!line.options.quiet) fmt::print("{}", validation_text(validation));
  if (!line.options.json.empty()) write_text_file(line.options.json, validation_json(validation));
  if (!line.output.empty()) write_validation(validation, line.output);
  return validation.failed() == 0 ? exit_ok : exit_failure;
}

int map_stability(const CommandLine& line, RunContext& run) {
  make_output_folder(line.output);
  const Stability found = stability(line.stability, run);
  write_stability(found, line.output);
  if (!line.options.quiet)
    fmt::print("{}{}\n", stability_text(found),
               (std::filesystem::path(line.output) / "stability.html").string());
  return found.broken() == 0 ? exit_ok : exit_failure;
}

int redo_studies(const CommandLine& line, RunContext& run) {
  const std::vector<Study> chosen = chosen_studies(line.study);
  if (!line.markdown.empty()) check_folder_of(line.markdown);
  make_output_folder(line.output);
  const std::filesystem::path page =
      write_studies(run_studies(chosen, line.studies, run), line.output, line.markdown);
  if (!line.options.quiet) fmt::print("{}\n", page.string());
  return exit_ok;
}

// Ctrl-C ends the program at once: files appear by renaming, so only a pending temporary has to go.
extern "C" void on_interrupt(int) {
  remove_pending_file();
  constexpr char message[] = "\ninterrupted; no file was changed\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, sizeof(message) - 1);
  _exit(exit_failure);
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "knotlight renders translucent objects: photon map, diffusion equation, boundary knots");
  app.name("knotlight");
  app.set_version_flag(
      "--version", fmt::format("knotlight {} ({})", KNOTLIGHT_VERSION,
                               *KNOTLIGHT_COMMIT != '\0' ? KNOTLIGHT_COMMIT : "no commit known"));
  app.require_subcommand(1);
  CommandLine line;

  CLI::App& render_command = *app.add_subcommand("render", "render a picture of the scene");
  add_common_options(render_command, line);
  render_command.add_option("-o,--output", line.output,
                            "picture, .exr (linear) or .png (tone-mapped); default: both");
  render_command.add_option("--layers", line.layers,
                            "further channels of the .exr: all, or names with commas between");
  render_command.add_option("--save-solution", line.save_solution,
                            "keep the solved fields in this file, for other pictures of them");
  render_command.add_option("--solution", line.solution,
                            "take the fields from this file, solve nothing; the scene must be the "
                            "same but for camera and exitance");
  CLI::App& reference_command = *app.add_subcommand(
      "reference", "the same picture by Monte Carlo path tracing, with its variance");
  add_common_options(reference_command, line);
  reference_command.add_option("-o,--output", line.output,
                               "picture, .exr (linear, with variance) or .png; default: both");
  reference_command.add_option("--spp", line.samples, "samples per pixel; default: camera.samples")
      ->check(CLI::Range(1.0, 1e9));
  CLI::App& probe_command = *app.add_subcommand("probe", "evaluate the solved field at points");
  add_common_options(probe_command, line);
  probe_command.add_option("--points", line.points, "CSV with columns x, y, z")->required();
  probe_command.add_option("-o,--output", line.output, "CSV to write")->required();
  CLI::App& info_command =
      *app.add_subcommand("info", "say what the scene is and what would be solved");
  add_common_options(info_command, line);
  CLI::App& view_command = *app.add_subcommand(
      "view", "a window: turn the object, move lights, change materials, see it solved anew");
  add_common_options(view_command, line);
  CLI::App& compare_command =
      *app.add_subcommand("compare", "source models side by side: pictures, charts, one page");
  add_common_options(compare_command, line);
  compare_command.add_option("-o,--output", line.output, "folder to write to")->required();
  compare_command
      .add_option("--photons", line.compare.photons,
                  "rays of the photon map per channel, in place of solver.photons; left out: as "
                  "many as bring the noise near the tolerance")
      ->check(CLI::Range(1.0, 5e8));
  CLI::App& chart_command = *app.add_subcommand(
      "chart", "error against seconds for every method and setting: tables, charts, one page");
  chart_command.add_option("scenes", line.scenes,
                           "scene files (YAML); none: sphere, torus, plate and bunny");
  chart_command
      .add_option("--set", line.options.overrides, "override a scene key: path.to.key=value")
      ->allow_extra_args(false)
      ->take_all();
  add_run_options(chart_command, line);
  chart_command.add_option("-o,--output", line.output, "folder to write to, or to go on in")
      ->required();
  chart_command
      .add_option("--budget", line.chart.budget,
                  "seconds per scene for settings; a longer one goes on where a shorter one ended")
      ->check(CLI::Range(1.0, 1e7))
      ->capture_default_str();
  chart_command.add_option("--levels", line.chart.levels, "settings per line, coarse to fine")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  chart_command.add_option("--repeats", line.chart.repeats, "runs of each setting, for its noise")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  chart_command.add_option("--noise", line.chart.noise, "of the blocks of path tracing, relative")
      ->check(CLI::Range(1e-4, 1.0))
      ->capture_default_str();
  chart_command.add_flag("--quick", line.quick_chart, "two coarse settings per line; seconds");
  CLI::App& validate_command = *app.add_subcommand(
      "validate", "the whole program on cases whose answer is known; exit code 1 if any fails");
  add_run_options(validate_command, line);
  validate_command.add_option("-o,--output", line.output,
                              "folder for tables, charts and a page; default: none");
  validate_command.add_option("--only", line.validate.only, "the cases whose name contains this");
  validate_command.add_flag("--quick", line.validate.quick,
                            "the few small cases that together see every factor; seconds");
  CLI::App& stability_command = *app.add_subcommand(
      "stability",
      "maps of where each method fails; exit code 1 if one crashes, hangs, or is wrong unnoticed");
  add_run_options(stability_command, line);
  stability_command.add_option("-o,--output", line.output, "folder to write to")->required();
  stability_command.add_flag("--quick", line.stability.quick,
                             "a few cells of each map and two scenes; seconds");
  CLI::App& study_command = *app.add_subcommand(
      "study", "an experiment of the thesis done again: tables, charts, a page");
  study_command.add_option("name", line.study, "which one, or all of them: all")->required();
  add_run_options(study_command, line);
  study_command.add_option("-o,--output", line.output, "folder to write to")->required();
  study_command.add_option("--markdown", line.markdown,
                           "where the page for the repository goes; left out: to that folder");
  study_command.add_flag("--quick", line.studies.quick, "smaller and fewer; seconds");
  for (CLI::App* command :
       {&render_command, &reference_command, &probe_command, &compare_command, &validate_command})
    command->add_option("--json", line.options.json, "write a summary to this file");
  CLI::Option* info_json =
      info_command
          .add_option("--json", line.options.json,
                      "trace photons of all orders too and write a summary to this file, or to "
                      "standard output if none is named")
          ->expected(0, 1);

  const std::vector<std::string> names = {"render",   "reference", "probe", "compare", "chart",
                                          "validate", "stability", "study", "info",    "view"};
  if (argc < 2)
    throw InputError(
        fmt::format("no command given, expected {} (see knotlight --help)", one_of(names)));
  const std::string word = argv[1];
  if (!word.empty() && word.front() != '-' &&
      std::find(names.begin(), names.end(), word) == names.end())
    throw InputError(fmt::format("{}: no such command, expected {}{}", word, one_of(names),
                                 did_you_mean(word, names)));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {  // --help, --version
    return app.exit(wish);
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{} (see knotlight --help)", error.what()));
  }
  line.json_wanted = info_json->count() > 0;

  if (!line.options.json.empty()) check_folder_of(line.options.json);
  const bool bars = !line.options.quiet && isatty(STDERR_FILENO) != 0;
  RunContext run(line.options, bars);
  if (render_command.parsed()) return render(line, run);
  if (reference_command.parsed()) return reference(line, run);
  if (probe_command.parsed()) return probe(line, run);
  if (compare_command.parsed()) return compare(line, run);
  if (chart_command.parsed()) return chart(line, run);
  if (validate_command.parsed()) return validate_program(line, run);
  if (stability_command.parsed()) return map_stability(line, run);
  if (study_command.parsed()) return redo_studies(line, run);
  if (view_command.parsed()) return view(line);
  return info(line, run);
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  using namespace knotlight;
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return exit_failure;
  }
}
