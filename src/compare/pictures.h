// The pictures of a comparison's page.
#pragma once

#include <string>
#include <vector>

#include "compare/figures.h"

namespace knotlight {

// The converged picture and every model's, at one exposure.
std::vector<std::string> picture_figures(const Comparison& comparison);

// U_d on the surface, converged, with its colour bar.
std::string surface_figure(const Comparison& comparison);

// One difference map per model with a common scale and its bar. `name`: unique on the page.
std::string difference_figures(const Comparison& comparison, ValueMap ComparedModel::*map,
                               const std::string& name);

// The source densities on one logarithmic scale with its bar.
std::string slice_figures(const Comparison& comparison);

}  // namespace knotlight
