// The measurements of one scene, and of several, as pages for people.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chart/measurement.h"

namespace knotlight {

struct ChartedScene {
  std::string name, path;
  double truth_noise = 0.0;    // of path tracing's blocks, relative
  double truth_seconds = 0.0;  // CPU
  int repeats = 1;
  std::size_t untried = 0;  // settings that the budget did not reach
  // Converged runs that are not to be trusted, and why: what is measured against them is not
  // either.
  std::vector<std::string> doubts;
  std::vector<Measurement> measurements;
};

// One HTML page that stands alone. Needs gnuplot.
std::string chart_page(const ChartedScene& scene);

// The charts of that page by themselves: a name and an SVG element each.
std::vector<std::pair<std::string, std::string>> chart_svgs(const ChartedScene& scene);

// Several scenes: seconds for 2 % and 1 % of ours and of every rival, side by side.
std::string chart_index(const std::vector<ChartedScene>& scenes);
std::string ratios_csv(const std::vector<ChartedScene>& scenes);

}  // namespace knotlight
