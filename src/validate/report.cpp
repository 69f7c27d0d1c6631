#include "validate/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file_io.h"
#include "report/chart.h"
#include "report/csv.h"
#include "report/html.h"

namespace knotlight {
namespace {

const char* verdict(const ValidationRow& row) {
  if (!row.judged) return "-";
  return row.passed() ? "pass" : "FAIL";
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names{"case",  "quantity", "value", "reference",
                                              "error", "allowed",  "why",   "verdict"};
  return names;
}

// Display width: code points, all of ours being one column wide.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t to) {
  return text + std::string(to - std::min(to, width(text)), ' ');
}

// Smaller shares of what is allowed are drawn here: exact sums would spread the scale over twelve
// decades.
constexpr double smallest_drawn = 1e-3;

// Each figure's error over what is allowed, in the order of the table.
Chart error_chart(const Validation& validation) {
  Chart chart{"error of every figure over what is allowed (1 = the limit)",
              "figure",
              "error / allowed",
              false,
              true,
              {}};
  ChartSeries limit{"limit", {}, {}, {}, true, false};
  double figure = 0.0;
  for (const ValidatedCase& c : validation.cases)
    for (const ValidationRow& row : c.rows) {
      if (!row.judged) continue;
      figure += 1.0;
      const bool passed = row.passed();
      const std::string name = passed ? "passed" : "failed";
      auto series = std::find_if(chart.series.begin(), chart.series.end(),
                                 [&](const ChartSeries& s) { return s.name == name; });
      if (series == chart.series.end())
        series = chart.series.insert(chart.series.end(), {name, {}, {}, {}, false, true});
      series->x.push_back(figure);
      series->y.push_back(
          std::isnan(row.error) ? row.error : std::max(smallest_drawn, row.error / row.allowed));
      limit.x.push_back(figure);
      limit.y.push_back(1.0);
    }
  chart.series.push_back(limit);
  return chart;
}

Chart curve_chart(const ValidatedCase& c, const ValidationCurve& curve) {
  const bool wide_range =
      *std::min_element(curve.reference.begin(), curve.reference.end()) > 0.0 &&
      *std::max_element(curve.reference.begin(), curve.reference.end()) >
          30.0 * *std::min_element(curve.reference.begin(), curve.reference.end());
  return {c.name,
          curve.x_label,
          curve.y_label,
          false,
          wide_range,
          {{"reference", curve.x, curve.reference, {}, true, false},
           {"computed", curve.x, curve.value, {}, false, true}}};
}

// File names of letters, digits and single dashes.
std::string file_word(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
    if (plain)
      word += c;
    else if (!word.empty() && word.back() != '-')
      word += '-';
  }
  return word;
}

std::string curves_csv(const Validation& validation) {
  std::vector<std::vector<std::string>> rows;
  for (const ValidatedCase& c : validation.cases)
    for (const ValidationCurve& curve : c.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        rows.push_back({c.name, curve.x_label, csv_number(curve.x[i]), curve.y_label,
                        csv_number(curve.value[i]), csv_number(curve.reference[i])});
  return csv_text({"case", "x_label", "x", "y_label", "value", "reference"}, rows);
}

}  // namespace

std::string validation_verdict(const Validation& validation) {
  const std::size_t failed = validation.failed();
  return fmt::format("{} of {} figures within what is allowed{}", validation.judged() - failed,
                     validation.judged(), failed == 0 ? "" : fmt::format("; {} FAILED", failed));
}

std::string validation_text(const Validation& validation) {
  std::size_t longest = 0;
  for (const ValidatedCase& c : validation.cases)
    for (const ValidationRow& row : c.rows) longest = std::max(longest, width(row.quantity));
  std::string text;
  for (const ValidatedCase& c : validation.cases) {
    text += fmt::format("{} ({:.1f} s)\n", c.name, c.seconds);
    for (const ValidationRow& row : c.rows)
      text += fmt::format("  {}  {:>12}  {:>12}  {:>9}  {:>9}  {}\n", padded(row.quantity, longest),
                          number(row.value), number(row.reference), percent(row.error),
                          row.judged ? percent(row.allowed) : "-", verdict(row));
  }
  return fmt::format("  {}  {:>12}  {:>12}  {:>9}  {:>9}\n", padded("quantity", longest), "value",
                     "reference", "error", "allowed") +
         text + validation_verdict(validation) + "\n";
}

std::string validation_csv(const Validation& validation) {
  std::vector<std::vector<std::string>> rows;
  for (const ValidatedCase& c : validation.cases)
    for (const ValidationRow& row : c.rows)
      rows.push_back({c.name, row.quantity, csv_number(row.value), csv_number(row.reference),
                      csv_number(row.error), row.judged ? csv_number(row.allowed) : "", row.why,
                      verdict(row)});
  return csv_text(columns(), rows);
}

// What is not finite is written as null, by the library.
std::string validation_json(const Validation& validation) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const ValidatedCase& c : validation.cases) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const ValidationRow& row : c.rows) {
      nlohmann::ordered_json one{{"quantity", row.quantity},
                                 {"value", row.value},
                                 {"reference", row.reference},
                                 {"error", row.error}};
      if (row.judged) {
        one["allowed"] = row.allowed;
        one["passed"] = row.passed();
      }
      one["why"] = row.why;
      rows.push_back(one);
    }
    cases.push_back({{"name", c.name}, {"seconds", c.seconds}, {"figures", rows}});
  }
  return nlohmann::ordered_json{{"command", "validate"},
                                {"version", KNOTLIGHT_VERSION},
                                {"judged", validation.judged()},
                                {"failed", validation.failed()},
                                {"cases", cases}}
             .dump(2) +
         "\n";
}

void write_validation(const Validation& validation, const std::string& folder) {
  make_output_folder(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    write_text_file((std::filesystem::path(folder) / name).string(), text);
  };
  const auto write_svg = [&](const std::string& name, const std::string& svg) {
    write(name + ".svg", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg);
  };
  write("validate.csv", validation_csv(validation));
  write("validate-curves.csv", curves_csv(validation));

  std::string body = html_callout(validation_verdict(validation));
  if (validation.judged() > 0) {
    const std::string errors = chart_svg(error_chart(validation));
    write_svg("validate-errors", errors);
    body += html_figure_svg(errors, "errors", "Figures in the order of the tables below.");
  }
  for (const ValidatedCase& c : validation.cases) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> classes;
    for (const ValidationRow& row : c.rows) {
      rows.push_back({row.quantity, number(row.value), number(row.reference), percent(row.error),
                      row.judged ? percent(row.allowed) : "-", row.why, verdict(row)});
      classes.push_back(!row.judged ? "" : row.passed() ? "pass" : "fail");
    }
    body += html_heading(2, c.name);
    body += html_table({columns().begin() + 1, columns().end()}, rows, classes);
    for (std::size_t i = 0; i < c.curves.size(); ++i) {
      const std::string svg = chart_svg(curve_chart(c, c.curves[i]));
      const std::string name = fmt::format("{}-{}", file_word(c.name), i);
      write_svg("validate-" + name, svg);
      body += html_figure_svg(svg, "c" + name, fmt::format("{} ({:.1f} s)", c.name, c.seconds));
    }
  }
  write(
      "validate.html",
      html_page("knotlight validate",
                "The whole program on cases whose answer is known: in closed form, as a series, or "
                "from the transfer equation.",
                body));
}

}  // namespace knotlight
