// The one place that starts gnuplot.
#pragma once

#include <string>

namespace knotlight {

// What gnuplot (5.4 or later) prints when given the script. Throws std::runtime_error if the
// program is missing or fails, with its first line of complaint.
std::string run_gnuplot(const std::string& script);

}  // namespace knotlight
