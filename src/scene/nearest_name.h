// "Did you mean ...?": the valid name with the smallest edit distance from what was typed.
#pragma once

#include <string>
#include <vector>

namespace knotlight {

// Insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string
// alignment distance).
std::size_t edit_distance(const std::string& a, const std::string& b);

// " (did you mean 'x'?)", or nothing if no valid name is near.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& valid);

// "a, b or c".
std::string one_of(const std::vector<std::string>& names);

}  // namespace knotlight
