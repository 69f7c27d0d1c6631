// Numbers as colours, with a bar that tells which is which.
#pragma once

#include <string>
#include <vector>

#include "core/image_io.h"

namespace knotlight {

// sequential: dark violet to yellow (viridis [vdW15]), for amounts. diverging: blue over white to
// red, for differences; its range should be symmetric about zero. Both keep their order for the
// colour-blind.
enum class ColourMap { sequential, diverging };

// Display colour, sRGB 0..1, of t; outside 0..1 the end colours. Not-a-number: light grey.
Spectrum map_colour(ColourMap map, double t);

// A map of values, row by row from the top. NaN: nothing there.
struct ValueMap {
  int width = 0, height = 0;
  std::vector<double> values;
};

struct ColourScale {
  ColourMap map = ColourMap::sequential;
  double low = 0.0, high = 1.0;
};

// The map as a picture of display values. Where nothing is there: light grey.
Image false_colour(const ValueMap& map, const ColourScale& scale);

// The scale as an SVG element: a bar with the values at its ends and middle, and a label.
std::string colour_bar_svg(const ColourScale& scale, const std::string& label);

// The value that a share `quantile` (0..1) of the finite values lies below in size (|value|); 0 if
// there are none. For scales that a few outliers do not spoil.
double quantile_of_size(const ValueMap& map, double quantile);

}  // namespace knotlight
