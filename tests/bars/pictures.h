// Charts of what was measured.
#pragma once

#include <string>
#include <vector>

#include "measure.h"

namespace knotlight {

// Relative L2 error against CPU seconds, which other work on the machine changes little, a line per
// method. fem_csv: rows case,mesh,unknowns,cpu_seconds,
// relative_l2_error of another program, drawn beside them if the case is theirs; empty = none.
std::string error_against_seconds(const std::string& case_name, const std::vector<Measured>& runs,
                                  const std::string& fem_csv);

// CPU seconds and peak memory against triangles, a line per method and series.
std::string seconds_against_triangles(const std::vector<Measured>& runs);
std::string memory_against_triangles(const std::vector<Measured>& runs);

}  // namespace knotlight
