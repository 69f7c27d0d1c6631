// How time and memory grow with the surface's detail at a fixed tolerance.
#pragma once

#include <string>
#include <vector>

#include "measure.h"

namespace knotlight {

// Two series per method, triangles doubling from about a thousand to at most `most`:
// "bumpy": the same surface in ever more triangles, with its error;
// "rippled": ever finer ripples, whose answer is not known.
// Prints a line per run.
std::vector<Measured> measure_detail(const std::vector<std::string>& methods, std::size_t most,
                                     const RunOptions& options);

}  // namespace knotlight
