// One run of the whole pipeline, measured.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cases.h"
#include "pipeline/run_options.h"

namespace knotlight {

// Figures of a run that could not be are not-a-number.
struct Measured {
  std::string case_name, method, chosen, source;  // asked for; what the run said it took
  std::string setting;                            // what was varied beside them
  double bar = 0.0;
  double triangles = 0.0;      // of the surface
  double l2_error = 0.0;       // |U_d - reference| / |reference|, over the points
  double largest_error = 0.0;  // max |U_d - reference| / max |reference|
  double error_estimate = 0.0, numerical_error = 0.0, noise = 0.0, energy_imbalance = 0.0;
  int exit_code = 0;         // of the command line; -s: killed by signal s
  double seconds = 0.0;      // scene to values at all points, wall clock
  double cpu_seconds = 0.0;  // the same, summed over threads
  std::vector<std::pair<std::string, double>> stages;
  double peak_mib = 0.0;
  std::string note;  // the first complaint
};

// Writes the mesh that the scene names, if it has to be made. What goes wrong is printed, and shows
// as a scene whose mesh is missing.
void make_mesh(const BarsCase& c);

// Runs the case by a method (a word of solver.method) with more overrides, in a child process.
// Prints nothing.
Measured measure(const BarsCase& c, const std::string& method, const RunOptions& options);

std::vector<std::string> table_header();
std::vector<std::string> table_row(const Measured& m);
// One line for people, and its heading.
std::string heading();
std::string line(const Measured& m);

}  // namespace knotlight
