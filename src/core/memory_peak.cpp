#include "core/memory_peak.h"

#include <malloc.h>

#include <fstream>
#include <string>

#include "core/not_finite.h"

namespace knotlight {
namespace {

// A line of /proc/self/status such as "VmHWM:  1234 kB", in MiB; NaN if there is none.
double status_MiB(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  return nan;
}

}  // namespace

MemoryPeak::MemoryPeak() {
  malloc_trim(0);  // what earlier runs freed is not in use
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5" << std::flush;  // sets the peak back
  before_ = reset ? status_MiB("VmRSS") : nan;
}

double MemoryPeak::MiB() const {
  return status_MiB("VmHWM") - before_;
}

}  // namespace knotlight
