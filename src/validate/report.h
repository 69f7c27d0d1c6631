// What `validate` shows and writes.
#pragma once

#include <string>

#include "validate/validate.h"

namespace knotlight {

// Aligned columns for a terminal: case, quantity, value, reference, error, allowed, verdict, and a
// line with the count at the end.
std::string validation_text(const Validation& validation);

// One sentence: how many figures were judged and how many failed.
std::string validation_verdict(const Validation& validation);

// Same columns and the reason for `allowed`; one line per figure.
std::string validation_csv(const Validation& validation);

// Keys: docs/results/validate.md.
std::string validation_json(const Validation& validation);

// Writes validate.csv, validate-curves.csv, validate-*.svg and the page validate.html that holds
// all of it to the folder, which is made if it is not there. Throws std::runtime_error if gnuplot
// is missing.
void write_validation(const Validation& validation, const std::string& folder);

}  // namespace knotlight
