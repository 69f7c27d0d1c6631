// A comparison as a page for people and as tables for programs.
#pragma once

#include <string>

#include "compare/figures.h"

namespace knotlight {

// One HTML page that stands alone. Needs gnuplot.
std::string compare_page(const Comparison& comparison);

// A row per model: why it was not run, errors (relative), seconds, MiB.
std::string compare_csv(const Comparison& comparison);
// Per line and cell: depth, place, U_d of the photons with its standard error, of the converged
// solution and of every model, W/(length^2 sr).
std::string lines_csv(const Comparison& comparison);
// Per model and budget: seconds and error on the surface; channel 0.
std::string budgets_csv(const Comparison& comparison);

}  // namespace knotlight
