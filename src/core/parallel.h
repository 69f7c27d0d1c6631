// A parallel loop over chunks whose borders do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace knotlight {

class Workers {
 public:
  // threads = 0: one per hardware thread.
  explicit Workers(int threads = 0);
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
};

}  // namespace knotlight
