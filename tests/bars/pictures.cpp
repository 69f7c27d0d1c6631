#include "pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "report/chart.h"

namespace knotlight {
namespace {

constexpr const char* declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

// One series per name, in the order names first come up.
void add_point(Chart& chart, const std::string& name, double x, double y) {
  auto series = std::find_if(chart.series.begin(), chart.series.end(),
                             [&](const ChartSeries& s) { return s.name == name; });
  if (series == chart.series.end()) {
    series = chart.series.emplace(chart.series.end());
    series->name = name;
  }
  series->x.push_back(x);
  series->y.push_back(y);
}

std::string against_triangles(const std::vector<Measured>& runs, const std::string& title,
                              const std::string& y_label,
                              const std::function<double(const Measured&)>& y) {
  Chart chart{title, "triangles", y_label, true, true, {}};
  for (const Measured& m : runs)
    add_point(chart, fmt::format("{}, {}", m.method, m.case_name), m.triangles, y(m));
  return declaration + chart_svg(chart);
}

}  // namespace

std::string error_against_seconds(const std::string& case_name, const std::vector<Measured>& runs,
                                  const std::string& fem_csv) {
  Chart chart{case_name, "CPU seconds", "relative L2 error of U_d", true, true, {}};
  for (const Measured& m : runs)
    if (m.case_name == case_name) add_point(chart, m.method, m.cpu_seconds, m.l2_error);
  std::ifstream in(fem_csv);
  std::string row;
  while (std::getline(in, row)) {
    std::vector<std::string> fields;
    std::istringstream stream(row);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (fields.size() == 5 && fields[0] == case_name)
      add_point(chart, "finite elements (P2, tetgen)", std::stod(fields[3]), std::stod(fields[4]));
  }
  return declaration + chart_svg(chart);
}

std::string seconds_against_triangles(const std::vector<Measured>& runs) {
  return against_triangles(runs, "Time and detail", "CPU seconds",
                           [](const Measured& m) { return m.cpu_seconds; });
}

std::string memory_against_triangles(const std::vector<Measured>& runs) {
  return against_triangles(runs, "Memory and detail", "peak memory, MiB",
                           [](const Measured& m) { return m.peak_mib; });
}

}  // namespace knotlight
