// The way of a flight through the grid against clipping it by every cell.
#include "photon/flux_grid.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

const FluxGrid grid{Vec3(-1, 0, 2), Vec3(1.5, 1, 2.7), {5, 4, 3}};
constexpr double rounding = 1e-12;  // lengths are of order 1

double length_in(const Bounds& b, const Vec3& start, const Vec3& direction, double flight) {
  double t0 = 0.0;
  double t1 = flight;
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) {
      if (start[a] < b.lo[a] || start[a] >= b.hi[a]) return 0.0;
      continue;
    }
    const double u = (b.lo[a] - start[a]) / direction[a];
    const double v = (b.hi[a] - start[a]) / direction[a];
    t0 = std::max(t0, std::min(u, v));
    t1 = std::min(t1, std::max(u, v));
  }
  return std::max(0.0, t1 - t0);
}

TEST(FluxGrid, LengthsAreThoseOfClipping) {
  Rng rng(1, Stream::tests, 0);
  double crossed = 0.0;
  for (int i = 0; i < 3000; ++i) {
    // In and around the grid; every fourth flight along an axis.
    const Vec3 start(-1.5 + 3.5 * rng.uniform(), -0.5 + 2.0 * rng.uniform(),
                     1.6 + 1.5 * rng.uniform());
    const double u = rng.uniform();
    Vec3 direction = sample_sphere(u, rng.uniform());
    if (i % 4 == 0) direction = (i % 8 == 0 ? 1.0 : -1.0) * Vec3::Unit(i / 8 % 3);
    const double flight = 2.0 * rng.uniform();
    std::vector<double> lengths(grid.cells(), 0.0);
    grid.along(start, direction, flight, [&](std::size_t c, double s) { lengths[c] += s; });
    for (std::size_t c = 0; c < lengths.size(); ++c) {
      EXPECT_NEAR(lengths[c], length_in(grid.cell_bounds(c), start, direction, flight), rounding);
      crossed += lengths[c] > 0.0 ? 1.0 : 0.0;
    }
  }
  EXPECT_GT(crossed, 2000.0);
}

// Flights within the planes between cells belong to the upper cells, once.
TEST(FluxGrid, AlongABorder) {
  const FluxGrid unit{Vec3(0, 0, 0), Vec3(2, 2, 2), {2, 2, 2}};
  std::vector<double> lengths(8, 0.0);
  unit.along(Vec3(1, 1, -1), Vec3::UnitZ(), 2.5, [&](std::size_t c, double s) { lengths[c] += s; });
  EXPECT_EQ(lengths, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 0.5}));
}

TEST(FluxGrid, PointsAndCells) {
  EXPECT_EQ(grid.cells(), 60U);
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    const Bounds b = grid.cell_bounds(c);
    EXPECT_EQ(grid.cell_at(b.center()), c);
    EXPECT_TRUE((b.hi - b.lo).isApprox(grid.cell_size(), rounding));
  }
  EXPECT_EQ(grid.cell_at(grid.lo), 0U);
  EXPECT_FALSE(grid.cell_at(grid.hi));
  EXPECT_FALSE(grid.cell_at(Vec3(0, -0.01, 2.5)));
}

}  // namespace
}  // namespace knotlight
