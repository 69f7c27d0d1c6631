#include "stability/report.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "core/file_io.h"
#include "report/csv.h"
#include "report/html.h"
#include "stability/figures.h"

namespace knotlight {
namespace {

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

std::string verdict(const ExtremeTrial& t) {
  if (t.crashed()) return "CRASHED";
  if (t.wrong()) return "WRONG";
  if (t.too_slow()) return "TOO SLOW";
  return t.exit_code == 0 ? "trusted" : "not trusted";
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

std::string scene_tables(const Stability& stability) {
  std::string body;
  for (const ExtremeScene& scene : stability.scenes) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> classes;
    for (const ExtremeTrial& t : stability.extremes) {
      if (t.scene != scene.name) continue;
      rows.push_back({t.method, std::to_string(t.exit_code), percent(t.error),
                      percent(t.error_estimate), percent(t.allowed),
                      fmt::format("{:.1f} s", t.seconds), verdict(t), joined(t.failures)});
      classes.push_back(t.breaks_the_rule() ? "fail" : t.exit_code == 0 ? "pass" : "");
    }
    body += html_heading(3, fmt::format("{}: {}", scene.name, scene.trouble));
    body += html_table(
        {"method", "exit code", "true error", "estimate", "allowed", "time", "verdict", "why"},
        rows, classes);
  }
  return body;
}

}  // namespace

std::string stability_verdict(const Stability& stability) {
  std::size_t trusted = 0;
  for (const ExtremeTrial& t : stability.extremes) trusted += t.exit_code == 0 ? 1U : 0U;
  const std::size_t broken = stability.broken();
  return fmt::format(
      "{} of {} runs of extreme scenes are trusted; {} crashed, hung, or were wrong and trusted",
      trusted, stability.extremes.size(), broken == 0 ? "none" : std::to_string(broken));
}

std::string stability_text(const Stability& stability) {
  std::string text = fmt::format("  {:<18} {:<11} {:>4} {:>10} {:>10} {:>8}  {}\n", "scene",
                                 "method", "exit", "error", "estimate", "seconds", "verdict");
  for (const ExtremeTrial& t : stability.extremes)
    text += fmt::format("  {:<18} {:<11} {:>4} {:>10} {:>10} {:>8.1f}  {}\n", t.scene, t.method,
                        t.exit_code, percent(t.error), percent(t.error_estimate), t.seconds,
                        verdict(t));
  return text + stability_verdict(stability) + "\n";
}

std::string trials_csv(const Stability& stability) {
  std::vector<std::vector<std::string>> rows;
  for (const Trial& t : stability.trials)
    rows.push_back({t.study, t.body, t.method, t.field, csv_number(t.lambda_R),
                    csv_number(t.albedo), t.parameter, csv_number(t.value), csv_number(t.noise),
                    csv_number(t.outcome.error), csv_number(t.outcome.unknowns),
                    csv_number(t.outcome.rank), csv_number(t.outcome.condition),
                    csv_number(t.outcome.coefficient_size), csv_number(t.outcome.iterations)});
  return csv_text(
      {"study", "body", "method", "field", "lambda_R", "albedo", "parameter", "value", "noise",
       "error", "unknowns", "rank", "condition", "coefficient_size", "iterations"},
      rows);
}

std::string scenes_csv(const Stability& stability) {
  std::vector<std::vector<std::string>> rows;
  for (const ExtremeTrial& t : stability.extremes)
    rows.push_back({t.scene, t.method, std::to_string(t.exit_code), csv_number(t.error),
                    csv_number(t.error_estimate), csv_number(t.allowed), t.finite ? "yes" : "no",
                    csv_number(t.seconds), verdict(t), joined(t.failures)});
  return csv_text({"scene", "method", "exit_code", "error", "error_estimate", "allowed", "finite",
                   "seconds", "verdict", "why"},
                  rows);
}

void write_stability(const Stability& stability, const std::string& folder) {
  const std::vector<StabilityFigure> figures = stability_figures(stability);
  std::vector<std::pair<std::string, std::string>> files{
      {"stability.csv", trials_csv(stability)}, {"stability-scenes.csv", scenes_csv(stability)}};
  std::string body = html_callout(stability_verdict(stability));
  std::string section;
  for (const StabilityFigure& figure : figures) {
    if (figure.section != section) body += html_heading(2, section = figure.section);
    body += html_figure_svg(figure.svg, figure.name, figure.caption);
    files.emplace_back("stability-" + figure.name + ".svg",
                       "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + figure.svg);
  }
  body += scene_tables(stability);
  files.emplace_back(
      "stability.html",
      html_page("knotlight stability",
                "Where each method fails: on exact boundary value problems by themselves, and as "
                "part of the whole program in scenes that ask for trouble.",
                body));
  for (const auto& [name, text] : files)
    write_text_file((std::filesystem::path(folder) / name).string(), text);
}

}  // namespace knotlight
