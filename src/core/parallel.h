// A parallel loop over chunks whose borders do not depend on the number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace knotlight {

// Thrown by Workers::for_chunks when its work is no longer wanted. Not an error, and so no
// std::exception.
struct Cancelled {};

class Workers {
 public:
  // threads = 0: one per hardware thread. cancelled, if not null, must outlive all copies; once it
  // is true for_chunks begins no further chunk and throws Cancelled.
  explicit Workers(int threads = 0, const std::atomic<bool>* cancelled = nullptr);
  int threads() const { return threads_; }

  // Calls body(chunk, begin, end) once for each chunk of up to `chunk_size` of the indices 0..n-1.
  // The body must write only to what belongs to its chunk. Sums over chunks are to be taken in
  // chunk order afterwards; then results are the same bits for any thread count. The first
  // exception thrown by a body is rethrown here.
  void for_chunks(
      std::size_t n, std::size_t chunk_size,
      const std::function<void(std::size_t chunk, std::size_t begin, std::size_t end)>& body) const;

 private:
  int threads_;
  const std::atomic<bool>* cancelled_;
};

}  // namespace knotlight
