#include "chart/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/front.h"
#include "report/chart.h"
#include "report/csv.h"
#include "report/html.h"

namespace knotlight {
namespace {

std::string percent_or_dash(double value) {
  return std::isfinite(value) ? fmt::format("{:.2g} %", 100.0 * value) : "-";
}
std::string number_or_dash(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::vector<std::string> lines_of(const std::vector<Measurement>& all) {
  std::vector<std::string> lines;
  for (const Measurement& m : all)
    if (std::find(lines.begin(), lines.end(), m.line) == lines.end()) lines.push_back(m.line);
  return lines;
}

bool begins(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

bool of_field(const std::string& line) {
  return line == our_field_line || begins(line, "grid, irr") || begins(line, "grid, bound") ||
         line == "lbkm, p1" || line == "mfs, p1" || line == "bkm, p1" ||
         line == "bkm_thesis, photon_map" || line == "bkm_thesis, irradiance_thesis" ||
         begins(line, dipole_line) || line == finite_elements_line;
}
bool of_thesis(const std::string& line) {
  return begins(line, "bkm_thesis") || line == our_field_line;
}
bool of_exitance(const std::string& line) {
  return line == "grid" || begins(line, "grid, gros") || begins(line, "grid, p1") ||
         line == "grid, lambert" || line == "grid, mean_intensity";
}
bool of_picture(const std::string& line) {
  return line == default_line || line == "grid" || line == "lbkm" || line == "mfs" ||
         line == "bkm" || line == "bkm_thesis, photon_map" || begins(line, dipole_line) ||
         line == path_tracing_line;
}

// Each line a series, the front dashed, what is not to be trusted in points of its own. Empty:
// there is nothing to draw.
std::string svg_of(const ChartedScene& scene, Quantity quantity, const std::string& title,
                   bool (*wanted)(const std::string& line)) {
  Chart chart{title, "CPU seconds", "error, per cent", true, true, {}};
  ChartSeries doubtful{"not to be trusted (exit 3)", {}, {}, {}, false, true};
  std::size_t points = 0;
  for (const std::string& line : lines_of(scene.measurements)) {
    if (!wanted(line)) continue;
    ChartSeries series{line, {}, {}, {}, true, true};
    for (const Measurement& m : scene.measurements) {
      const double x = seconds_of(m, quantity), y = 100.0 * error_of(m, quantity);
      if (m.line != line || !(x > 0.0) || !(y > 0.0) || !std::isfinite(y)) continue;
      ChartSeries& target = m.trusted() ? series : doubtful;
      target.x.push_back(x);
      target.y.push_back(y);
      target.error.push_back(100.0 * noise_of(m, quantity));
      ++points;
    }
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  if (points == 0) return "";
  ChartSeries front{"front", {}, {}, {}, true, false, true};
  for (const Measurement& m : pareto_front(scene.measurements, quantity)) {
    front.x.push_back(seconds_of(m, quantity));
    front.y.push_back(100.0 * error_of(m, quantity));
  }
  if (!front.x.empty()) chart.series.push_back(std::move(front));
  if (!doubtful.x.empty()) chart.series.push_back(std::move(doubtful));
  return chart_svg(chart);
}

struct Drawing {
  const char* name;  // of the file
  const char* title;
  Quantity quantity;
  bool (*wanted)(const std::string& line);
};
const Drawing methods{"picture-methods", "Picture: methods and rivals", Quantity::picture,
                      of_picture};
const Drawing exitances{"picture-exitance", "Picture: how light leaves, and what is solved",
                        Quantity::picture, of_exitance};
const Drawing fields{"field", "Field: methods and sources", Quantity::field, of_field};
const Drawing thesis{"field-thesis", "Field: the thesis's method, its estimators and floats",
                     Quantity::field, of_thesis};

std::string figure(const ChartedScene& scene, const Drawing& drawing,
                   const std::string& before = "") {
  const std::string title = before + drawing.title;
  const std::string svg = svg_of(scene, drawing.quantity, title, drawing.wanted);
  if (svg.empty()) return html_paragraph(title + ": nothing was measured.");
  return html_figure_svg(svg, scene.name + "-" + drawing.name, "");
}

const std::vector<double> aims = {0.05, 0.02, 0.01, 0.005};

std::string recommendations(const ChartedScene& scene, Quantity quantity) {
  std::vector<std::vector<std::string>> rows;
  for (const double aim : aims) {
    const auto best = cheapest(scene.measurements, quantity, aim);
    if (best)
      rows.push_back({percent_or_dash(aim), best->line, best->setting,
                      number_or_dash(seconds_of(*best, quantity)),
                      percent_or_dash(error_of(*best, quantity))});
    else
      rows.push_back({percent_or_dash(aim), "none that was measured", "", "-", "-"});
  }
  return html_table({"for an error of", "use", "with", "CPU s", "error measured"}, rows);
}

std::string tolerance_table(const ChartedScene& scene, Quantity quantity) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> classes;
  for (const ToleranceCheck& check : check_tolerance(scene.measurements, quantity)) {
    rows.push_back({check.chosen.setting, number_or_dash(seconds_of(check.chosen, quantity)),
                    percent_or_dash(error_of(check.chosen, quantity)), check.best.name(),
                    number_or_dash(seconds_of(check.best, quantity)),
                    fmt::format("{:.2f}", check.ratio)});
    classes.emplace_back(check.ratio <= 2.0 ? "pass" : "fail");
  }
  if (rows.empty()) return html_paragraph("No default setting was measured here.");
  return html_table({"default settings", "CPU s", "error", "as good for less", "CPU s", "ratio"},
                    rows, classes);
}

std::string whole_table(const ChartedScene& scene) {
  std::vector<std::vector<std::string>> rows;
  for (const Measurement& m : scene.measurements) {
    std::vector<std::string> row = {m.line, m.setting, number_or_dash(m.field_seconds),
                                    number_or_dash(m.picture_seconds), number_or_dash(m.memory)};
    for (const ErrorParts* parts : {&m.field, &m.picture})
      for (const double value : {parts->error, parts->noise, parts->numerical, parts->model})
        row.push_back(percent_or_dash(value));
    row.push_back(m.failed);
    rows.push_back(std::move(row));
  }
  return html_table(
      {"line", "setting", "CPU s: field", "picture", "MiB", "field: error", "noise", "numerical",
       "model", "picture: error", "noise", "numerical", "model", "not to be trusted because"},
      rows);
}

struct Rival {
  const char* name;
  const char* line;
};
const std::vector<Rival> field_rivals = {{"lbkm", "lbkm, p1"},
                                         {"mfs (exterior sources)", "mfs, p1"},
                                         {"bkm", "bkm, p1"},
                                         {"bkm_thesis", "bkm_thesis, photon_map"},
                                         {"dipole", dipole_line},
                                         {"dipole, better form", better_dipole_line},
                                         {"finite elements", finite_elements_line}};
const std::vector<Rival> picture_rivals = {{"lbkm", "lbkm"},
                                           {"mfs (exterior sources)", "mfs"},
                                           {"bkm", "bkm"},
                                           {"bkm_thesis", "bkm_thesis, photon_map"},
                                           {"dipole", dipole_line},
                                           {"dipole, better form", better_dipole_line},
                                           {"path tracing", path_tracing_line}};

// What a user gets who sets nothing but the tolerance.
const char* our_line(Quantity quantity) {
  return quantity == Quantity::field ? our_field_line : default_line;
}

// A rival's seconds over ours, or the least error that it came to.
std::string ratio(const ChartedScene& scene, const char* line, Quantity quantity, double error) {
  const auto theirs = seconds_for(scene.measurements, line, quantity, error);
  const auto ours = seconds_for(scene.measurements, our_line(quantity), quantity, error);
  if (theirs && ours)
    return fmt::format("{}{:.3g}", theirs->extrapolated ? "~" : "",
                       theirs->seconds / ours->seconds);
  if (theirs)
    return fmt::format("{}{:.3g} s, ours not so near", theirs->extrapolated ? "~" : "",
                       theirs->seconds);
  const auto measured = [&](const Measurement& m) { return m.line == line; };
  if (std::none_of(scene.measurements.begin(), scene.measurements.end(), measured))
    return "not measured";
  const double least = least_error(scene.measurements, line, quantity);
  if (!std::isfinite(least)) return "not trusted";
  return fmt::format("at best {:.3g} %{}", 100.0 * least, scene.untried > 0 ? " so far" : "");
}

// Per scene: our seconds, what the best of all our settings would take, a row for each rival.
std::vector<std::vector<std::string>> ratio_rows(const std::vector<ChartedScene>& scenes,
                                                 Quantity quantity, double error) {
  const std::string what = quantity == Quantity::field ? "field" : "picture";
  const std::vector<std::string> start = {what, percent_or_dash(error)};
  std::vector<std::vector<std::string>> rows(2, start);
  rows[0].push_back(fmt::format("knotlight ({}), CPU s", our_line(quantity)));
  rows[1].emplace_back("the best of all our settings, in hindsight / knotlight");
  for (const ChartedScene& scene : scenes) {
    const auto own = seconds_for(scene.measurements, our_line(quantity), quantity, error);
    const auto best = cheapest(scene.measurements, quantity, error);
    const double least = least_error(scene.measurements, our_line(quantity), quantity);
    const std::string none =
        std::isfinite(least) ? fmt::format("at best {:.3g} %", 100.0 * least) : "not trusted";
    rows[0].push_back(own ? number_or_dash(own->seconds) : none);
    rows[1].push_back(own && best ? number_or_dash(seconds_of(*best, quantity) / own->seconds)
                                  : "-");
  }
  for (const Rival& rival : quantity == Quantity::field ? field_rivals : picture_rivals) {
    std::vector<std::string> row = start;
    row.push_back(fmt::format("{} / knotlight", rival.name));
    for (const ChartedScene& scene : scenes)
      row.push_back(ratio(scene, rival.line, quantity, error));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::vector<std::string>> all_ratio_rows(const std::vector<ChartedScene>& scenes) {
  std::vector<std::vector<std::string>> rows;
  for (const Quantity quantity : {Quantity::field, Quantity::picture})
    for (const double error : {0.02, 0.01})
      for (auto& row : ratio_rows(scenes, quantity, error)) rows.push_back(std::move(row));
  return rows;
}

std::vector<std::string> ratio_header(const std::vector<ChartedScene>& scenes) {
  std::vector<std::string> header = {"of", "error", "seconds or ratio"};
  for (const ChartedScene& scene : scenes) header.push_back(scene.name);
  return header;
}

}  // namespace

std::string chart_page(const ChartedScene& scene) {
  std::string body;
  if (scene.untried > 0)
    body += html_callout(fmt::format(
        "{} settings were left out for lack of time: run again with the same folder to go on.",
        scene.untried));
  if (!scene.doubts.empty()) {
    body += html_callout(
        "Converged runs that did not pass their own checks; fields, numerical and model errors "
        "that "
        "are measured against them are not to be trusted:");
    body += html_list(scene.doubts);
  }
  body += html_heading(2, "The picture");
  body += html_paragraph(
      "Root mean square over blocks of 8 x 8 pixels of the difference to path tracing, in per cent "
      "of the mean; path tracing's own noise is taken off. Bars: what differs from seed to seed.");
  body += figure(scene, methods);
  body += figure(scene, exitances);
  body += recommendations(scene, Quantity::picture);
  body += html_heading(2, "The field on the surface");
  body += html_paragraph(
      "Root mean square of U_d over the surface against converged diffusion with photons as the "
      "source, of its own root mean square.");
  body += figure(scene, fields);
  body += figure(scene, thesis);
  body += recommendations(scene, Quantity::field);
  body += html_heading(2, "Does tolerance choose well?");
  body += html_paragraph(
      "What the program chooses by itself, beside the cheapest of our settings whose picture is no "
      "worse. A ratio up to 2 passes.");
  body += tolerance_table(scene, Quantity::picture);
  body += html_heading(2, "All that was measured");
  body += html_paragraph(fmt::format(
      "Means of {} runs with seeds of their own. Noise is what differs between them; numerical, "
      "what else "
      "keeps a run from its own model with everything converged; model, what that has itself. Path "
      "tracing was followed for {:.0f} CPU seconds, to {} noise per block.",
      scene.repeats, scene.truth_seconds, percent_or_dash(scene.truth_noise)));
  body += whole_table(scene);
  return html_page("What each second buys: " + scene.name, scene.path, body);
}

std::vector<std::pair<std::string, std::string>> chart_svgs(const ChartedScene& scene) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const Drawing& drawing : {methods, exitances, fields, thesis})
    if (std::string svg = svg_of(scene, drawing.quantity, drawing.title, drawing.wanted);
        !svg.empty())
      files.emplace_back(drawing.name, std::move(svg));
  return files;
}

std::string chart_index(const std::vector<ChartedScene>& scenes) {
  std::string body = html_heading(2, "Seconds of the rivals, over ours");
  body += html_paragraph(
      "CPU seconds of the cheapest trusted setting that was measured to have no larger error. "
      "~: path tracing, by its noise. At best: the least error of any trusted setting of that "
      "line; so "
      "far: the budget ended before the finest.");
  body += html_table(ratio_header(scenes), all_ratio_rows(scenes));
  for (const ChartedScene& scene : scenes) {
    body += html_heading(2, scene.name);
    body += figure(scene, methods, scene.name + ". ");
    body += figure(scene, fields, scene.name + ". ");
    body += recommendations(scene, Quantity::picture);
  }
  return html_page("What each second buys", "Error against CPU seconds, scene by scene.", body);
}

std::string ratios_csv(const std::vector<ChartedScene>& scenes) {
  return csv_text(ratio_header(scenes), all_ratio_rows(scenes));
}

}  // namespace knotlight
