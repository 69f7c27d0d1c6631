#include "core/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/clock.h"

namespace knotlight {
namespace {

constexpr int bar_width = 30;
constexpr long redraw_interval_ms = 100;  // often enough to look alive, too seldom to cost anything

}  // namespace

Stage::Stage(Stages& owner, std::string name, std::size_t total)
    : owner_(owner), name_(std::move(name)), total_(total), start_(Clock::now()) {
  if (owner_.bars_) draw(0.0, 0.0);
}

Stage::~Stage() {
  const double seconds = seconds_since(start_);
  owner_.record(name_, seconds);
  if (owner_.bars_) fmt::print(stderr, "\r\033[K{:<16} {:6.1f} s\n", name_, seconds);
}

void Stage::advance(std::size_t items) {
  const std::size_t done = done_ += items;
  if (!owner_.bars_ || total_ == 0) return;
  const double seconds = seconds_since(start_);
  const long now_ms = static_cast<long>(1000.0 * seconds);
  long last = last_drawn_ms_;
  if (now_ms - last < redraw_interval_ms) return;
  if (!last_drawn_ms_.compare_exchange_strong(last, now_ms)) return;  // another thread draws
  draw(std::min(1.0, static_cast<double>(done) / static_cast<double>(total_)), seconds);
}

void Stage::draw(double fraction, double seconds) const {
  const int filled = static_cast<int>(fraction * bar_width);
  std::string line = fmt::format("\r\033[K{:<16} [{:#<{}}{:.<{}}] {:3.0f}%", name_, "", filled, "",
                                 bar_width - filled, 100.0 * fraction);
  if (fraction > 0.0) line += fmt::format("  {:.1f} s left", seconds * (1.0 / fraction - 1.0));
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
}

void Stages::record(const std::string& name, double seconds) {
  const auto found = std::find_if(seconds_.begin(), seconds_.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  if (found == seconds_.end())
    seconds_.emplace_back(name, seconds);
  else
    found->second += seconds;
}

}  // namespace knotlight
