#include "stability/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/false_colour.h"
#include "report/html.h"

namespace knotlight {
namespace {

// Pixels.
constexpr double cell_width = 36.0, cell_height = 19.0;
constexpr double above = 26.0, below = 44.0, right = 14.0, least_left = 60.0;
constexpr double bar_height = 46.0;
constexpr double letter = 5.6;  // width of one at the size of the cells' numbers
constexpr int bar_steps = 60;

std::string text(double x, double y, const char* anchor, const char* more,
                 const std::string& what) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor,
                     more, html_escape(what));
}

std::string colour(const Spectrum& c) {
  const Spectrum bytes = 255.0 * c;
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", bytes[0], bytes[1], bytes[2]);
}

// 1.2e-3 as 1e-3: one digit and the power of ten say what a map is for; 0.1 to 999 as they are.
std::string short_number(double value) {
  if (std::isnan(value)) return "";
  if (std::isinf(value)) return "∞";
  const double size = std::abs(value);
  constexpr double fits = 999.5;
  if (size >= 9.95 && size < fits) return fmt::format("{:.0f}", value);
  if (value == 0.0 || (size >= 0.0995 && size < 9.95)) return fmt::format("{:.2g}", value);
  std::string digits = fmt::format("{:.0e}", value);
  const auto zero = digits.find("e-0");
  if (zero != std::string::npos) digits.erase(zero + 2, 1);
  const auto plus = digits.find("e+");
  if (plus != std::string::npos) digits.erase(plus + 1, digits[plus + 2] == '0' ? 2 : 1);
  return digits;
}

double place(double value, const HeatScale& scale) {
  if (!(value > 0.0)) return value;  // zero: the low end's colour; not-a-number stays
  return std::log(value / scale.low) / std::log(scale.high / scale.low);
}

std::string cells(const HeatMap& map, const HeatScale& scale, double x0, double y0) {
  std::string svg;
  for (std::size_t row = 0; row < map.y.size(); ++row)
    for (std::size_t column = 0; column < map.x.size(); ++column) {
      const double value = map.values[row * map.x.size() + column];
      const double t = place(value, scale);
      const Spectrum fill = map_colour(ColourMap::sequential, std::isinf(value) ? 1.0 : t);
      const double x = x0 + cell_width * static_cast<double>(column);
      const double y = y0 + cell_height * static_cast<double>(row);
      svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
                         x, y, cell_width, cell_height, colour(fill));
      constexpr double dark = 0.5;  // mean of the channels below which letters are white
      svg += text(x + 0.5 * cell_width, y + 13.0, "middle",
                  fill.mean() < dark ? " fill=\"#fff\"" : "", short_number(value));
    }
  return svg;
}

// Room for the names of the rows.
double left_of(const HeatMap& map) {
  double most = least_left;
  for (const std::string& name : map.y)
    most = std::max(most, 10.0 + letter * static_cast<double>(name.size()));
  return most;
}

std::string one_map(const HeatMap& map, const HeatScale& scale, double x, double y) {
  if (map.values.size() != map.x.size() * map.y.size())
    throw std::runtime_error(fmt::format("map '{}': {} values for {} x {} cells", map.title,
                                         map.values.size(), map.x.size(), map.y.size()));
  const double x0 = x + left_of(map), y0 = y + above;
  const double width = cell_width * static_cast<double>(map.x.size());
  const double height = cell_height * static_cast<double>(map.y.size());
  std::string svg = text(x0 + 0.5 * width, y0 - 9.0, "middle",
                         " font-size=\"12\" font-weight=\"bold\"", map.title);
  svg += cells(map, scale, x0, y0);
  for (std::size_t column = 0; column < map.x.size(); ++column)
    svg += text(x0 + cell_width * (static_cast<double>(column) + 0.5), y0 + height + 13.0, "middle",
                "", map.x[column]);
  for (std::size_t row = 0; row < map.y.size(); ++row)
    svg +=
        text(x0 - 5.0, y0 + cell_height * static_cast<double>(row) + 13.0, "end", "", map.y[row]);
  svg += text(x0 + 0.5 * width, y0 + height + 29.0, "middle", "", map.x_label);
  return svg + text(x0 - 5.0, y0 - 9.0, "end", "", map.y_label);
}

std::string colour_bar(const HeatScale& scale, double x, double y) {
  std::string svg = text(x, y + 11.0, "start", "", scale.label);
  constexpr double step = 5.0;
  for (int i = 0; i < bar_steps; ++i)
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"5.2\" height=\"12\" fill=\"{}\"/>",
                       x + step * i, y + 16.0,
                       colour(map_colour(ColourMap::sequential, (i + 0.5) / bar_steps)));
  svg += text(x, y + 40.0, "start", "", short_number(scale.low));
  return svg + text(x + step * bar_steps, y + 40.0, "end", "", short_number(scale.high));
}

}  // namespace

std::string heat_maps_svg(const std::vector<HeatMap>& maps, std::size_t per_row,
                          const HeatScale& scale) {
  std::string body;
  double x = 0.0, y = bar_height, row_height = 0.0, width = least_left + 5.0 * bar_steps + right;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (i % per_row == 0) {
      x = 0.0;
      y += row_height;
      row_height = 0.0;
    }
    body += one_map(maps[i], scale, x, y);
    // A title may be longer than its map.
    const double cells_wide = cell_width * static_cast<double>(maps[i].x.size());
    const double title_wide = 1.3 * letter * static_cast<double>(maps[i].title.size());
    x += left_of(maps[i]) + std::max(cells_wide, 0.5 * (cells_wide + title_wide)) + right;
    width = std::max(width, x);
    row_height =
        std::max(row_height, above + cell_height * static_cast<double>(maps[i].y.size()) + below);
  }
  return fmt::format(
             "<svg viewBox=\"0 0 {:.0f} {:.0f}\" xmlns=\"http://www.w3.org/2000/svg\" "
             "font-family=\"sans-serif\" font-size=\"10\">"
             "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
             width, y + row_height) +
         colour_bar(scale, least_left, 2.0) + body + "</svg>";
}

}  // namespace knotlight
