// Seconds per stage, and a progress bar with the time left on a terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace knotlight {

class Stages;

// One running stage; ends when destroyed. advance() may be called from any thread.
class Stage {
 public:
  Stage(Stages& owner, std::string name, std::size_t total);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  void advance(std::size_t items = 1);

 private:
  void draw(double fraction, double seconds) const;

  Stages& owner_;
  std::string name_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::atomic<long> last_drawn_ms_{-1000};
  std::chrono::steady_clock::time_point start_;
};

// Collects the seconds of all stages in the order they ran; stages of one name add up.
class Stages {
 public:
  // bars: draw progress bars on stderr (the caller has checked that it is a terminal).
  explicit Stages(bool bars) : bars_(bars) {}
  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

 private:
  friend class Stage;
  void record(const std::string& name, double seconds);

  bool bars_;
  std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace knotlight
