// What a comparison comes to, in sentences made from its figures.
#pragma once

#include <string>
#include <vector>

#include "compare/figures.h"

namespace knotlight {

// First what the models are measured by, then one sentence per model, then which one to take.
std::vector<std::string> verdict(const Comparison& comparison);

// 0.0123 -> "1.2 %"; "unknown" for what is no number.
std::string percent(double share);

}  // namespace knotlight
