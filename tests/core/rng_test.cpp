#include "core/rng.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/statistics.h"

namespace knotlight {
namespace {

using test::chi_square_z;
using test::Mean;
using test::z_one_in_a_million;

TEST(Rng, SameKeySameNumbers) {
  Rng a(7, Stream::photons, 123);
  Rng b(7, Stream::photons, 123);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next_u32(), b.next_u32());
}

TEST(Rng, AnyPartOfTheKeyChangesTheNumbers) {
  const std::uint32_t reference = Rng(7, Stream::photons, 123).next_u32();
  EXPECT_NE(reference, Rng(8, Stream::photons, 123).next_u32());
  EXPECT_NE(reference, Rng(7, Stream::pixels, 123).next_u32());
  EXPECT_NE(reference, Rng(7, Stream::photons, 124).next_u32());
}

// 64 bins, 100 000 draws along one stream, and the first draw of 100 000 neighbouring streams
// (which is what photon tracing uses). False-alarm rate 5e-7 each.
TEST(Rng, UniformWithinAndAcrossStreams) {
  constexpr int bins = 64;
  constexpr int draws = 100'000;
  std::vector<double> within(bins, 0.0);
  std::vector<double> across(bins, 0.0);
  Rng stream(1, Stream::tests, 0);
  for (int i = 0; i < draws; ++i) {
    within[static_cast<std::size_t>(stream.uniform() * bins)] += 1.0;
    Rng own(1, Stream::tests, static_cast<std::uint64_t>(i));
    across[static_cast<std::size_t>(own.uniform() * bins)] += 1.0;
  }
  const std::vector<double> expected(bins, static_cast<double>(draws) / bins);
  EXPECT_LT(chi_square_z(within, expected), z_one_in_a_million);
  EXPECT_LT(chi_square_z(across, expected), z_one_in_a_million);
}

// Correlation of the first and second number of neighbouring streams: 100 000 pairs each,
// false-alarm rate 1e-6 each.
TEST(Rng, NeighbouringStreamsAreUncorrelated) {
  Mean same_stream;
  Mean next_stream;
  double previous = 0.5;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(3, Stream::tests, i);
    const double first = rng.uniform() - 0.5;
    same_stream.add(first * (rng.uniform() - 0.5));
    if (i > 0) next_stream.add(first * previous);
    previous = first;
  }
  EXPECT_LT(std::abs(same_stream.mean()), z_one_in_a_million * same_stream.standard_error());
  EXPECT_LT(std::abs(next_stream.mean()), z_one_in_a_million * next_stream.standard_error());
}

}  // namespace
}  // namespace knotlight
