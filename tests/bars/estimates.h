// Are error estimates any good? They are compared with true errors over random scenes.
#pragma once

#include <string>
#include <vector>

#include "measure.h"
#include "random_cases.h"

namespace knotlight {

// An estimate is good if it is no less than the true error and not more than five times it.
constexpr double lowest_ratio = 0.2, highest_ratio = 1.0;  // of true error to estimate
constexpr double tolerances_allowed = 3.0;                 // of the true error of a run of exit 0

struct Estimated {
  std::size_t index;  // of the random case
  std::uint64_t seed;
  std::string description;
  double tolerance;
  Measured run;

  double ratio() const { return run.l2_error / run.error_estimate; }
};

// Scenes 0 to count - 1 under options.seed, each by every method. Prints a line for each run, and
// writes the table (unless csv is empty) after each.
std::vector<Estimated> measure_estimates(const std::vector<std::string>& methods, std::size_t count,
                                         const RunOptions& options, const std::string& csv);

// Per method: the share of good estimates, every other one with its scene, and runs that are wrong
// with exit 0.
std::string summary(const std::vector<Estimated>& results);

// Estimate against true error, a point per run, with the borders of what is good.
std::string estimates_chart(const std::vector<Estimated>& results);

}  // namespace knotlight
