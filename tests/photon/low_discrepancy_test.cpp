#include "photon/low_discrepancy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Any one point is uniform over the keys: chi-square over 20 cells, 20 000 keys, false-alarm rate
// 1e-6 per coordinate.
TEST(LowDiscrepancy, AnyPointIsUniformOverTheKeys) {
  for (const int dimension : {0, 2}) {
    std::vector<double> counts(20, 0.0);
    for (std::uint64_t key = 0; key < 20'000; ++key)
      counts[static_cast<std::size_t>(20.0 * LowDiscrepancy(3, 7, key)(12'345, dimension))] += 1.0;
    EXPECT_LT(test::chi_square_z(counts, std::vector<double>(20, 1000.0)),
              test::z_one_in_a_million);
  }
}

// The sequence puts n x l points into any interval of length l but for a few, where n
// random ones err by sqrt(n l (1 - l)) = 150 here.
TEST(LowDiscrepancy, FillsIntervalsEvenly) {
  const LowDiscrepancy points(1, 3, 0);
  int inside = 0;
  for (std::uint64_t i = 0; i < 100'000; ++i) inside += points(i, 0) >= 0.2 && points(i, 0) < 0.55;
  EXPECT_NEAR(inside, 35'000, 15);
}

// rms error of the mean of a smooth function over 16 keys.
double rms_error(int dimensions, std::uint64_t n) {
  double squares = 0.0;
  for (std::uint64_t key = 0; key < 16; ++key) {
    const LowDiscrepancy points(dimensions, 1, key);
    double sum = 0.0;
    for (std::uint64_t i = 0; i < n; ++i) {
      double product = 1.0;
      for (int d = 0; d < dimensions; ++d)
        product *= 0.5 * pi * std::sin(pi * points(i, d));  // mean 1
      sum += product;
    }
    squares += std::pow(sum / static_cast<double>(n) - 1.0, 2);
  }
  return std::sqrt(squares / 16.0);
}

// The random error is sqrt((pi^2/8)^d - 1) / sqrt(n). This one is a fifth of it at 1000 points and
// a twentieth at 64 000, in 3 and in 5 dimensions (measured: below half of these).
TEST(LowDiscrepancy, SumsErrLessThanRandomOnes) {
  for (const int d : {3, 5}) {
    const double random = std::sqrt(std::pow(pi * pi / 8.0, d) - 1.0);
    EXPECT_LT(rms_error(d, 1000), 0.2 * random / std::sqrt(1e3)) << d;
    EXPECT_LT(rms_error(d, 64'000), 0.05 * random / std::sqrt(64e3)) << d;
  }
}

// The first 2^m points put just one into every box of volume 2^-m whose sides are powers of two, in
// the first two coordinates (a (0, 2)-sequence), scrambled or not.
TEST(LowDiscrepancy, OnePointInEveryElementaryBox) {
  const LowDiscrepancy points(2, 5, 1);
  constexpr int m = 10;
  for (int k = 0; k <= m; ++k) {
    std::vector<int> counts(1 << m, 0);
    for (std::uint64_t i = 0; i < 1U << m; ++i) {
      const auto x = static_cast<std::size_t>(std::ldexp(points(i, 0), k));
      const auto y = static_cast<std::size_t>(std::ldexp(points(i, 1), m - k));
      ++counts[(x << (m - k)) + y];
    }
    for (const int count : counts) ASSERT_EQ(count, 1) << k;
  }
}

// All five coordinates: 2^12 points, one in every interval of length 2^-12.
TEST(LowDiscrepancy, EveryCoordinateIsStratified) {
  const LowDiscrepancy points(5, 5, 1);
  for (int d = 0; d < 5; ++d) {
    std::vector<int> counts(1 << 12, 0);
    for (std::uint64_t i = 0; i < 1U << 12; ++i)
      ++counts[static_cast<std::size_t>(std::ldexp(points(i, d), 12))];
    for (const int count : counts) ASSERT_EQ(count, 1) << d;
  }
}

TEST(LowDiscrepancy, SameKeySamePointsOtherKeyOthers) {
  const LowDiscrepancy a(2, 1, 5), same(2, 1, 5), other(2, 1, 6), seed(2, 2, 5);
  EXPECT_EQ(a(4'000'000'000, 1), same(4'000'000'000, 1));
  EXPECT_NE(a(0, 0), other(0, 0));
  EXPECT_NE(a(0, 0), seed(0, 0));
}

}  // namespace
}  // namespace knotlight
