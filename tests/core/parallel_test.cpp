#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/progress.h"

namespace knotlight {
namespace {

TEST(Workers, EveryIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> seen(1003, 0);
    Workers(threads).for_chunks(seen.size(), 10,
                                [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                                  EXPECT_EQ(begin, chunk * 10);
                                  EXPECT_LE(end - begin, 10U);
                                  for (std::size_t i = begin; i < end; ++i) ++seen[i];
                                });
    EXPECT_EQ(seen, std::vector<int>(1003, 1));
  }
}

TEST(Workers, NothingToDo) {
  Workers(2).for_chunks(0, 10, [](std::size_t, std::size_t, std::size_t) { FAIL(); });
}

TEST(Workers, PassesTheErrorOn) {
  EXPECT_THROW(Workers(2).for_chunks(100, 1,
                                     [](std::size_t chunk, std::size_t, std::size_t) {
                                       if (chunk == 40) throw std::runtime_error("no");
                                     }),
               std::runtime_error);
}

// No chunk begins after the word; those under way end.
TEST(Workers, StopWhenCancelled) {
  for (const int threads : {1, 3}) {
    std::atomic<bool> cancelled{false};
    std::atomic<int> begun{0};
    EXPECT_THROW(Workers(threads, &cancelled)
                     .for_chunks(1000, 1,
                                 [&](std::size_t, std::size_t, std::size_t) {
                                   if (++begun == 40) cancelled = true;
                                 }),
                 Cancelled);
    EXPECT_LT(begun, 40 + threads);
    cancelled = false;
    Workers(threads, &cancelled).for_chunks(10, 1, [](std::size_t, std::size_t, std::size_t) {});
  }
}

TEST(Stages, AddUpByNameInOrder) {
  Stages stages(false);
  { const Stage a(stages, "photons", 10); }
  { const Stage b(stages, "solve", 10); }
  { const Stage c(stages, "photons", 10); }
  ASSERT_EQ(stages.seconds().size(), 2U);
  EXPECT_EQ(stages.seconds()[0].first, "photons");
  EXPECT_EQ(stages.seconds()[1].first, "solve");
  EXPECT_GE(stages.seconds()[0].second, 0.0);
}

}  // namespace
}  // namespace knotlight
