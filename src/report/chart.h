// Line charts as SVG, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

namespace knotlight {

struct ChartSeries {
  std::string name;
  std::vector<double> x, y, error;  // of one length; error: half a bar's height, empty = no bars
  bool line = true;
  bool points = true;
  bool dashed = false;  // of the line
};

struct Chart {
  std::string title, x_label, y_label;  // plain text, UTF-8
  bool log_x = false, log_y = false;
  std::vector<ChartSeries> series;
};

// The chart as an SVG element that scales with its surroundings and can stand inside an HTML page
// or, after an XML declaration, in a file. The colours can be told apart by the colour-blind.
// Points that cannot be drawn (not finite, or not positive on a logarithmic axis) leave a gap in
// their line. The same chart gives the same bytes. Throws std::runtime_error if gnuplot is missing
// or fails, if the lists of a series differ in length, or if there is no point to draw at all.
std::string chart_svg(const Chart& chart);

}  // namespace knotlight
