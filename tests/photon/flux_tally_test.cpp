// Sums and standard errors by hand.
#include "photon/flux_tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;
constexpr auto collisions = FluxEstimator::collisions;
constexpr auto track_lengths = FluxEstimator::track_lengths;

// Two cells of 1 x 1 x 1 in a row along x, the second of them half filled; sigma_t = 4.
FluxTally two_cells() {
  return {{Vec3(0, 0, 0), Vec3(2, 1, 1), {2, 1, 1}},
          7,
          box_mesh(Vec3(0, 0, 0), Vec3(1.5, 1, 1)),
          {1.0, 3.0, 0.0, 1.0, 0.0}};
}

FreeFlight flight(double x, double length, double power, std::uint32_t order, bool interacts) {
  return {Vec3(x, 0.5, 0.5), Vec3::UnitX(), length, power, 7, order, interacts};
}

TEST(FluxTally, ByHand) {
  FluxTally tally = two_cells();
  EXPECT_DOUBLE_EQ(tally.volume(1), 0.5);
  FluxSums first = tally.batch();
  first.add(flight(0.5, 0.75, 2.0, 0, true));    // 0.5 in cell 0, 0.25 and its end in cell 1
  first.add(flight(1.25, 0.25, 4.0, 3, false));  // in cell 1, ends at the surface
  tally.add(first);
  tally.add(tally.batch());  // a batch that sent nothing

  const Flux a = tally.flux(0, FluxOrder::unscattered, track_lengths);
  EXPECT_DOUBLE_EQ(a.U, 2.0 * 0.5 / (4.0 * pi));
  EXPECT_DOUBLE_EQ(a.F.x(), 2.0 * 0.5);
  EXPECT_EQ(a.F.y(), 0.0);
  EXPECT_EQ(tally.flux(0, FluxOrder::all, collisions).U, 0.0);
  EXPECT_EQ(tally.flux(0, FluxOrder::scattered, track_lengths).U, 0.0);

  const Flux b = tally.flux(1, FluxOrder::unscattered, collisions);
  EXPECT_DOUBLE_EQ(b.U, 2.0 / (4.0 * pi * 4.0 * 0.5));
  EXPECT_DOUBLE_EQ(b.F.x(), 2.0 / (4.0 * 0.5));
  EXPECT_DOUBLE_EQ(tally.flux(1, FluxOrder::scattered, track_lengths).F.x(), 4.0 * 0.25 / 0.5);
  const Flux all = tally.flux(1, FluxOrder::all, track_lengths);
  EXPECT_DOUBLE_EQ(all.F.x(), (2.0 * 0.25 + 4.0 * 0.25) / 0.5);
  // Batches of x and 0: the sum's standard error is sqrt(2 ((x/2)^2 + (x/2)^2)) = x.
  EXPECT_DOUBLE_EQ(all.F_error.x(), all.F.x());
  EXPECT_DOUBLE_EQ(all.U_error, all.U);
}

TEST(FluxTally, OtherObjectsDoNotCount) {
  FluxTally tally = two_cells();
  FluxSums sums = tally.batch();
  FreeFlight f = flight(0.5, 0.75, 2.0, 0, true);
  f.object = 6;
  sums.add(f);
  tally.add(sums);
  EXPECT_EQ(tally.flux(0, FluxOrder::all, track_lengths).U, 0.0);
}

TEST(FluxTally, OneBatchSaysNothingAboutItsError) {
  FluxTally tally = two_cells();
  tally.add(tally.batch());
  EXPECT_TRUE(std::isinf(tally.flux(0, FluxOrder::all, track_lengths).U_error));
}

TEST(FluxTally, NotANumberOutsideTheObject) {
  const FluxTally tally(FluxGrid{Vec3(2, 2, 2), Vec3(3, 3, 3), {1, 1, 1}}, 0, Sphere{},
                        {1.0, 1.0, 0.0, 1.0, 0.0});
  EXPECT_TRUE(std::isnan(tally.flux(0, FluxOrder::all, track_lengths).U));
}

}  // namespace
}  // namespace knotlight
