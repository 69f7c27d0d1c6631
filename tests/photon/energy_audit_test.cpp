#include "photon/energy_audit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

PowerTally tally(double incident, double absorbed) {
  PowerTally t;
  t.incident = incident;
  t.absorbed = absorbed;
  t.escaped = incident - absorbed;
  t.photons = 1;
  return t;
}

// By hand: batches of 2, 2 and 1 photons; incident 4, 2, 4 (sum 10), absorbed 1, 1, 2 (sum 4).
// Deviations of incident from 4, 4, 2: 0, -2, 2; of absorbed from 0.4 incident: -0.6, 0.2, 0.4.
TEST(EnergyAudit, StandardErrorsByHand) {
  const EnergyAudit a = energy_audit({tally(4, 1), tally(2, 1), tally(4, 2)}, {2, 2, 1});
  EXPECT_DOUBLE_EQ(a.incident, 10.0);
  EXPECT_DOUBLE_EQ(a.absorbed_fraction(), 0.4);
  EXPECT_EQ(a.photons, 3U);
  EXPECT_NEAR(a.standard_error_incident, std::sqrt(8.0 * 1.5), 1e-12);
  EXPECT_NEAR(a.standard_error_absorbed, std::sqrt((0.36 + 0.04 + 0.16) * 1.5), 1e-12);
  EXPECT_NEAR(a.standard_error_escaped, a.standard_error_absorbed, 1e-12);
}

TEST(EnergyAudit, OneBatchSaysNothingAboutItsError) {
  EXPECT_TRUE(std::isinf(energy_audit({tally(4, 1)}, {10}).standard_error_absorbed));
}

TEST(EnergyAudit, NothingArrived) {
  const EnergyAudit a = energy_audit({tally(0, 0), tally(0, 0)}, {5, 5});
  EXPECT_EQ(a.standard_error_absorbed, 0.0);
  EXPECT_TRUE(std::isnan(a.absorbed_fraction()));
}

}  // namespace
}  // namespace knotlight
