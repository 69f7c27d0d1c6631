// Which pictures the trials make.
#pragma once

#include <string>
#include <vector>

#include "stability/stability.h"

namespace knotlight {

struct StabilityFigure {
  std::string section;  // heading under which it stands; figures of one section follow each other
  std::string name;     // of its file, without stability- and .svg
  std::string svg;      // element
  std::string caption;
};

// Throws std::runtime_error if gnuplot is missing.
std::vector<StabilityFigure> stability_figures(const Stability& stability);

}  // namespace knotlight
