// What the methods are tried on: maps over two parameters and lines over one.
#pragma once

#include <functional>
#include <vector>

#include "stability/trial.h"

namespace knotlight {

// A cell or a column of cells: some trials that share their setting up. Independent of all others.
using StudyJob = std::function<std::vector<Trial>()>;

// quick: a few cells of each.
std::vector<StudyJob> study_jobs(bool quick, std::uint64_t seed);

}  // namespace knotlight
