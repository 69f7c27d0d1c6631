// The `validate` command: the whole program on cases whose answer is known.
#pragma once

#include <string>
#include <vector>

#include "pipeline/run_options.h"

namespace knotlight {

// One figure of a case. What error means is part of the quantity: relative to the reference unless
// it says otherwise.
struct ValidationRow {
  std::string quantity;
  double value = 0.0;
  double reference = 0.0;
  double error = 0.0;    // >= 0
  double allowed = 0.0;  // largest error that passes; not used where nothing is judged
  std::string why;       // where `allowed` comes from, or why nothing is judged
  bool judged = true;    // false: a difference between models, reported and not tested

  // Written so that not-a-number fails.
  bool passed() const { return !judged || error <= allowed; }
};

// A field along a line, for charts.
struct ValidationCurve {
  std::string x_label, y_label;
  std::vector<double> x, value, reference;
};

struct ValidatedCase {
  std::string name;
  std::vector<ValidationRow> rows;
  std::vector<ValidationCurve> curves;
  double seconds = 0.0;
};

struct Validation {
  std::vector<ValidatedCase> cases;

  std::size_t judged() const;
  std::size_t failed() const;
};

struct ValidateOptions {
  std::string only;    // cases whose name contains this
  bool quick = false;  // the few small cases that together see every factor of the physics
};

// Throws InputError if no case's name contains `only`. Same bits for any number of threads, seconds
// excepted.
Validation validate(const ValidateOptions& options, RunContext& run);

}  // namespace knotlight
