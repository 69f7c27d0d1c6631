// Work in a process of its own, so that its peak memory is its own and a crash is a figure too.
#pragma once

#include <functional>
#include <string>

namespace knotlight {

struct ChildResult {
  std::string output;     // what the work returned; empty if it did not come to an end
  int signal = 0;         // that ended it; 0 = it came to an end
  double peak_mib = 0.0;  // largest resident set, MiB
};

// Runs `work` in a forked child. To be called while the process has one thread. Throws
// std::runtime_error if there can be no child.
ChildResult run_in_child(const std::function<std::string()>& work);

}  // namespace knotlight
