// Maps of a figure over two parameters, several of them side by side in one picture.
#pragma once

#include <string>
#include <vector>

namespace knotlight {

struct HeatMap {
  std::string title, x_label, y_label;
  std::vector<std::string> x, y;  // names of columns and, from the top, of rows
  std::vector<double> values;     // row by row from the top; not-a-number: nothing there
};

// Colours follow the logarithm, from `low` (dark) to `high` (light); every cell has its number too,
// for which no colours are needed. What is beyond the ends has their colours.
struct HeatScale {
  double low = 1e-6, high = 1.0;  // > 0
  std::string label;
};

// An SVG element, `per_row` maps side by side. Throws std::runtime_error if a map has another
// number of values than cells.
std::string heat_maps_svg(const std::vector<HeatMap>& maps, std::size_t per_row,
                          const HeatScale& scale);

}  // namespace knotlight
