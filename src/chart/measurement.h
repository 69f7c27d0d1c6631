// What one setting gave on a scene: a row of the table.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "chart/contender.h"

namespace knotlight {

// Errors are relative root mean squares: `error` against the truth, of which `noise` is what
// differs from seed to seed, `numerical` what remains of the difference to the same model fully
// converged, and `model` what the converged one has itself. Not-a-number where there is nothing to
// measure.
struct ErrorParts {
  double error = std::numeric_limits<double>::quiet_NaN();
  double noise = std::numeric_limits<double>::quiet_NaN();
  double numerical = std::numeric_limits<double>::quiet_NaN();
  double model = std::numeric_limits<double>::quiet_NaN();
};

struct Measurement {
  std::string line, setting;
  int level = 0;
  std::string failed;  // why it is not to be trusted or did not run; empty: it is to be trusted
  // CPU seconds of all threads: to the solution, and to the finished picture (all of it).
  double field_seconds = std::numeric_limits<double>::quiet_NaN();
  double picture_seconds = std::numeric_limits<double>::quiet_NaN();
  double wall_seconds = std::numeric_limits<double>::quiet_NaN();  // to the picture
  double memory = std::numeric_limits<double>::quiet_NaN();        // MiB at the peak
  double estimate = std::numeric_limits<double>::quiet_NaN();      // its own error estimate
  ErrorParts field;    // U_d on the surface, against converged diffusion from photons
  ErrorParts picture;  // blocks of the picture, against path tracing

  std::string name() const { return line + "; " + setting; }
  bool trusted() const { return failed.empty(); }
};

std::string measurements_csv(const std::vector<Measurement>& measurements);
// Throws InputError if the text is no such table.
std::vector<Measurement> read_measurements(const std::string& path);

}  // namespace knotlight
