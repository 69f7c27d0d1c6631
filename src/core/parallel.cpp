#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace knotlight {

Workers::Workers(int threads, const std::atomic<bool>* cancelled)
    : threads_(threads > 0 ? threads
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      cancelled_(cancelled) {}

void Workers::for_chunks(
    std::size_t n, std::size_t chunk_size,
    const std::function<void(std::size_t, std::size_t, std::size_t)>& body) const {
  const std::size_t chunks = (n + chunk_size - 1) / chunk_size;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr first_error;
  std::mutex error_mutex;

  const auto work = [&] {
    while (!failed) {
      const std::size_t chunk = next++;
      if (chunk >= chunks) return;
      try {
        if (cancelled_ != nullptr && *cancelled_) throw Cancelled();
        body(chunk, chunk * chunk_size, std::min(n, (chunk + 1) * chunk_size));
      } catch (...) {
        const std::lock_guard lock(error_mutex);
        if (!first_error) first_error = std::current_exception();
        failed = true;
      }
    }
  };

  {
    std::vector<std::jthread> crew;
    const auto helpers = std::min<std::size_t>(chunks, static_cast<std::size_t>(threads_));
    for (std::size_t i = 1; i < helpers; ++i) crew.emplace_back(work);
    work();
  }
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace knotlight
