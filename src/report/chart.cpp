#include "report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "report/gnuplot.h"

namespace knotlight {
namespace {

constexpr const char* size_px = "760,440";

// Okabe and Ito's palette for colour-blind readers [OI08], the two palest colours left out.
constexpr std::array<const char*, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000"};
// gnuplot's filled circle, square, triangles, diamond: shapes tell series apart without colour.
constexpr std::array<int, 5> point_types = {7, 5, 9, 11, 13};

// The lower end of an error bar that reaches below zero on a logarithmic axis, as a share of the
// value: long enough to be seen to leave the point downwards, short enough to keep the scale.
constexpr double shortest_on_log = 0.1;

// In single quotes gnuplot leaves everything alone but the quote itself, which is doubled.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

bool drawable(double value, bool log) {
  return std::isfinite(value) && (!log || value > 0.0);
}

// One gnuplot data block: x, y, low end, high end. An empty line breaks the line drawn.
std::string data_block(const ChartSeries& series, const Chart& chart, std::size_t index,
                       std::size_t& points) {
  if (series.x.size() != series.y.size() ||
      (!series.error.empty() && series.error.size() != series.x.size()))
    throw std::runtime_error(fmt::format("chart '{}', series '{}': lists of different length",
                                         chart.title, series.name));
  std::string block = fmt::format("$series{} << END_OF_SERIES\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double x = series.x[i], y = series.y[i];
    if (!drawable(x, chart.log_x) || !drawable(y, chart.log_y)) {
      block += "\n";
      continue;
    }
    const double e =
        !series.error.empty() && std::isfinite(series.error[i]) ? series.error[i] : 0.0;
    const double low = chart.log_y ? std::max(y - e, shortest_on_log * y) : y - e;
    block += fmt::format("{} {} {} {}\n", x, y, low, y + e);
    ++points;
  }
  return block + "END_OF_SERIES\n";
}

std::string plot_elements(const ChartSeries& series, std::size_t index) {
  const char* colour = colours[index % colours.size()];
  // Colours start over after the palette: dashes tell the rounds apart.
  const std::size_t dash = series.dashed ? 2 : 1 + 2 * (index / colours.size());
  const int type = point_types[index % point_types.size()];
  std::string element;
  // Bars first: gnuplot clears the place of their own point, which the series' then fills.
  if (!series.error.empty())
    element = fmt::format(
        "$series{} using 1:2:3:4 with yerrorbars linecolor rgb '{}' linewidth 1.2 pointtype 0 "
        "notitle, \\\n  ",
        index, colour);
  const std::string style = series.line && series.points ? "linespoints"
                            : series.line                ? "lines"
                                                         : "points";
  element += fmt::format("$series{} using 1:2 with {} linecolor rgb '{}' linewidth 2 dashtype {}",
                         index, style, colour, dash);
  if (series.points) element += fmt::format(" pointtype {} pointsize 0.7", type);
  return element + fmt::format(" title {}", quoted(series.name));
}

std::string script(const Chart& chart) {
  // noenhanced: an underscore in a name is an underscore, no index.
  std::string text = fmt::format(
      "set terminal svg size {} dynamic noenhanced font 'sans-serif,14'\n"
      "set encoding utf8\n"
      "set title {}\nset xlabel {}\nset ylabel {}\n"
      "set border 3 linecolor rgb '#666666'\n"
      "set xtics nomirror\nset ytics nomirror\n"
      "set format '%g'\n"
      "set grid linetype 1 linecolor rgb '#dddddd' linewidth 0.7\n"
      "set key outside below center horizontal maxrows 3\n",
      size_px, quoted(chart.title), quoted(chart.x_label), quoted(chart.y_label));
  if (chart.log_x) text += "set logscale x\n";
  if (chart.log_y) text += "set logscale y\n";
  std::size_t points = 0;
  std::string plot;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const std::size_t before = points;
    text += data_block(chart.series[i], chart, i, points);
    if (points == before) continue;  // gnuplot refuses a series without a point
    plot += (plot.empty() ? "plot " : ", \\\n  ") + plot_elements(chart.series[i], i);
  }
  if (points == 0)
    throw std::runtime_error(fmt::format("chart '{}' has no point to draw", chart.title));
  return text + plot + "\n";
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  std::string svg = run_gnuplot(script(chart));
  // The declaration of the XML file has no place inside a page.
  const auto start = svg.find("<svg");
  if (start == std::string::npos)
    throw std::runtime_error("gnuplot drew no SVG for chart '" + chart.title + "'");
  svg.erase(0, start);
  // What a reader hears or sees on hovering; gnuplot puts its own name there.
  const std::string placeholder = "<title>Gnuplot</title>";
  const auto title = svg.find(placeholder);
  if (title != std::string::npos) svg.erase(title, placeholder.size());
  return svg;
}

}  // namespace knotlight
