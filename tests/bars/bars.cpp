// Accuracy, time and memory of the methods on cases whose answer is known, the whole pipeline from
// scene file to values on the surface. docs/results/bars.md shows what came out.
//
//   bars [METHOD...] [--cases 'sphere*'] [--set key=value] [--csv FILE]
//   bars [METHOD...] --cases bunny --tolerances 0.04 0.02 0.01 --svg FILE   error against seconds
//   bars [METHOD...] --detail 1000000 --svg STEM                            time and memory growth
//   bars [METHOD...] --estimates 50 --svg FILE                              error estimates judged
#include <fmt/format.h>
#include <fnmatch.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "cases.h"
#include "core/file_io.h"
#include "detail.h"
#include "estimates.h"
#include "measure.h"
#include "pictures.h"
#include "report/csv.h"

namespace knotlight {
namespace {

struct CommandLine {
  std::vector<std::string> methods{"auto"};
  std::vector<std::string> cases{"*"};
  std::vector<std::string> tolerances;
  std::size_t detail = 0;     // most triangles; 0 = no such run
  std::size_t estimates = 0;  // random scenes; 0 = no such run
  std::string csv, svg, fem = KNOTLIGHT_ROOT "/tests/bars/fem.csv";
  RunOptions options;
};

void parse(CommandLine& line, CLI::App& app) {
  app.add_option("methods", line.methods, "words of solver.method")->capture_default_str();
  app.add_option("--cases", line.cases, "names, with * and ?")->capture_default_str();
  app.add_option("--set", line.options.overrides, "override a scene key: path.to.key=value")
      ->allow_extra_args(false)
      ->take_all();
  app.add_option("--seed", line.options.seed, "seed of all random numbers")->capture_default_str();
  app.add_option("--threads", line.options.threads, "threads; 0 = one per core");
  app.add_option("--tolerances", line.tolerances, "run with each of these solver.tolerance");
  app.add_option("--detail", line.detail, "growth with detail, up to so many triangles");
  app.add_option("--estimates", line.estimates,
                 "compare estimates with true errors over so many random scenes; --seed draws "
                 "others");
  app.add_option("--csv", line.csv, "table to write, after every run");
  app.add_option("--svg", line.svg,
                 "chart to write: error against seconds of the last case; with --detail the stem "
                 "of two");
  app.add_option("--fem", line.fem, "figures of finite elements to draw beside")
      ->capture_default_str();
}

bool wanted(const std::string& name, const std::vector<std::string>& patterns) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
}

void write_table(const std::string& path, const std::vector<Measured>& runs) {
  if (path.empty()) return;
  std::vector<std::vector<std::string>> rows;
  for (const Measured& m : runs) rows.push_back(table_row(m));
  write_text_file(path, csv_text(table_header(), rows));
}

std::vector<Measured> measure_cases(const CommandLine& line) {
  std::vector<RunOptions> settings;
  for (const std::string& tolerance : line.tolerances) {
    settings.push_back(line.options);
    settings.back().overrides.push_back("solver.tolerance=" + tolerance);
  }
  if (settings.empty()) settings.push_back(line.options);

  std::vector<Measured> runs;
  for (const BarsCase& c : bars_cases()) {
    if (!wanted(c.name, line.cases)) continue;
    make_mesh(c);
    for (const std::string& method : line.methods)
      for (const RunOptions& options : settings) {
        runs.push_back(measure(c, method, options));
        fmt::print("{}\n", knotlight::line(runs.back()));
        std::fflush(stdout);
        write_table(line.csv, runs);
      }
  }
  return runs;
}

int run(const CommandLine& line) {
  if (line.estimates > 0) {
    const std::vector<Estimated> results =
        measure_estimates(line.methods, line.estimates, line.options, line.csv);
    fmt::print("{}", summary(results));
    if (!line.svg.empty()) write_text_file(line.svg, estimates_chart(results));
    return 0;
  }
  fmt::print("{}\n", heading());
  if (line.detail > 0) {
    const std::vector<Measured> runs = measure_detail(line.methods, line.detail, line.options);
    write_table(line.csv, runs);
    if (!line.svg.empty()) {
      write_text_file(line.svg + "-seconds.svg", seconds_against_triangles(runs));
      write_text_file(line.svg + "-memory.svg", memory_against_triangles(runs));
    }
    return 0;
  }
  const std::vector<Measured> runs = measure_cases(line);
  if (runs.empty()) {
    fmt::print(stderr, "bars: no such case\n");
    return 2;
  }
  if (!line.svg.empty())
    write_text_file(line.svg, error_against_seconds(runs.back().case_name, runs, line.fem));
  return 0;
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  knotlight::CommandLine line;
  CLI::App app("Accuracy, time and memory of every method on known cases");
  knotlight::parse(line, app);
  CLI11_PARSE(app, argc, argv);
  try {
    return knotlight::run(line);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bars: {}\n", error.what());
    return 1;
  }
}
