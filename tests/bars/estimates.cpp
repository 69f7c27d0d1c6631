#include "estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "child.h"
#include "core/file_io.h"
#include "report/chart.h"
#include "report/csv.h"

namespace knotlight {
namespace {

// Written so that not-a-number is not good.
bool good(const Estimated& e) {
  return e.ratio() >= lowest_ratio && e.ratio() <= highest_ratio;
}

bool wrong_and_trusted(const Estimated& e) {
  return e.run.exit_code == 0 && !(e.run.l2_error <= tolerances_allowed * e.tolerance);
}

std::string line_of(const Estimated& e) {
  return fmt::format(
      "{:>3} {:<13}{:<6}{:<6}{:>6}{:>10.2g}{:>10.2g}{:>10.2g}{:>10.2g}{:>7.2f}{:>5}{:>8.2f}  {}{}",
      e.index, e.run.case_name, e.run.method, e.run.chosen, e.tolerance, e.run.l2_error,
      e.run.error_estimate, e.run.numerical_error, e.run.noise, e.ratio(), e.run.exit_code,
      e.run.cpu_seconds, e.description, e.run.note.empty() ? "" : " | " + e.run.note);
}

std::string heading_of_lines() {
  return fmt::format("{:>3} {:<13}{:<6}{:<6}{:>6}{:>10}{:>10}{:>10}{:>10}{:>7}{:>5}{:>8}  {}", "no",
                     "case", "method", "chosen", "tol", "true", "estimate", "numerical", "noise",
                     "ratio", "exit", "cpu s", "scene | complaint");
}

void write_table(const std::string& path, const std::vector<Estimated>& results) {
  if (path.empty()) return;
  const std::vector<std::string> header = {
      "scene",  "case",   "description",       "seed",           "tolerance",
      "method", "chosen", "relative_l2_error", "error_estimate", "numerical_error",
      "noise",  "ratio",  "exit_code",         "seconds",        "cpu_seconds",
      "note"};
  const auto figure = [](double value) { return fmt::format("{:.4g}", value); };
  std::vector<std::vector<std::string>> rows;
  for (const Estimated& e : results)
    rows.push_back({std::to_string(e.index), e.run.case_name, e.description, std::to_string(e.seed),
                    fmt::format("{}", e.tolerance), e.run.method, e.run.chosen,
                    figure(e.run.l2_error), figure(e.run.error_estimate),
                    figure(e.run.numerical_error), figure(e.run.noise), figure(e.ratio()),
                    std::to_string(e.run.exit_code), fmt::format("{:.2f}", e.run.seconds),
                    fmt::format("{:.2f}", e.run.cpu_seconds), e.run.note});
  write_text_file(path, csv_text(header, rows));
}

std::vector<std::string> methods_of(const std::vector<Estimated>& results) {
  std::vector<std::string> methods;
  for (const Estimated& e : results)
    if (std::find(methods.begin(), methods.end(), e.run.method) == methods.end())
      methods.push_back(e.run.method);
  return methods;
}

// The line on which the true error is `ratio` times the estimate.
ChartSeries border(double ratio, double least, double largest) {
  ChartSeries series{fmt::format("true error = {:g} x estimate", ratio),
                     {least, largest},
                     {least / ratio, largest / ratio},
                     {}};
  series.points = false;
  series.dashed = true;
  return series;
}

}  // namespace

std::vector<Estimated> measure_estimates(const std::vector<std::string>& methods, std::size_t count,
                                         const RunOptions& options, const std::string& csv) {
  std::vector<Estimated> results;
  fmt::print("{}\n", heading_of_lines());
  for (std::size_t i = 0; i < count; ++i) {
    const RandomCase c = random_case(options.seed, i);
    make_mesh(c.scene);
    RunOptions run = options;
    run.seed = c.seed;
    for (const std::string& method : methods) {
      results.push_back({i, c.seed, c.description, c.scene.bar, measure(c.scene, method, run)});
      fmt::print("{}\n", line_of(results.back()));
      std::fflush(stdout);
      write_table(csv, results);
    }
  }
  return results;
}

std::string summary(const std::vector<Estimated>& results) {
  std::string text;
  for (const std::string& method : methods_of(results)) {
    std::size_t runs = 0, good_ones = 0, wrong = 0;
    std::string others;
    for (const Estimated& e : results) {
      if (e.run.method != method) continue;
      ++runs;
      wrong += wrong_and_trusted(e) ? 1 : 0;
      if (good(e))
        ++good_ones;
      else
        others += "  " + line_of(e) + "\n";
    }
    text += fmt::format(
        "{}: true error / estimate between {} and {} in {} of {} ({:.0f} %); exit 0 with more than "
        "{} tolerances: {}\n{}",
        method, lowest_ratio, highest_ratio, good_ones, runs,
        100.0 * static_cast<double>(good_ones) / static_cast<double>(runs), tolerances_allowed,
        wrong, others);
  }
  return text;
}

std::string estimates_chart(const std::vector<Estimated>& results) {
  Chart chart{"Error estimates of random scenes",
              "true error: relative L2 of U_d",
              "error estimate",
              true,
              true,
              {}};
  double least = 1.0, largest = 0.0;
  for (const std::string& method : methods_of(results)) {
    ChartSeries series;
    series.name = method;
    series.line = false;
    for (const Estimated& e : results) {
      if (e.run.method != method) continue;
      series.x.push_back(e.run.l2_error);
      series.y.push_back(e.run.error_estimate);
      least = std::min(least, e.run.l2_error);  // not-a-number leaves both as they are
      largest = std::max(largest, e.run.l2_error);
    }
    chart.series.push_back(std::move(series));
  }
  for (const double ratio : {lowest_ratio, highest_ratio})
    chart.series.push_back(border(ratio, least, largest));
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + chart_svg(chart);
}

}  // namespace knotlight
