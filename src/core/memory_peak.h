// How much memory a piece of work takes.
#pragma once

namespace knotlight {

// Peak memory from here on. The peak that the system keeps belongs to the whole process; it is set
// back to what is in use now (Linux).
class MemoryPeak {
 public:
  MemoryPeak();
  // Beyond what was in use before; NaN where the system does not tell.
  double MiB() const;

 private:
  double before_;
};

}  // namespace knotlight
