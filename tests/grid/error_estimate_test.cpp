#include "grid/error_estimate.h"

#include <gtest/gtest.h>

#include "grid/beam_on_sphere.h"

namespace knotlight {
namespace {

using namespace grid_cases;

// The estimate from two grids against the true error, relative to the largest value: at least the
// true one in most cases, and not ten times it. With a coarse grid of its own, and with the fine
// one's second level.
class EstimateFrom : public testing::TestWithParam<bool> {};

TEST_P(EstimateFrom, BracketsTheTrueError) {
  int above = 0, cases = 0;
  for (const BeamCase& beam : beam_cases())
    for (const double h : {2.0 / 48.0, 2.0 / 37.0}) {
      const double lambda = std::sqrt(3.0 * (1.0 - beam.albedo)) * beam.sigma_t;
      const auto g = geometry(Sphere{}, h);
      const GridField fine = beam_on_sphere(beam, g).field;
      const bool nested = GetParam();
      ASSERT_TRUE(g->has_nested_coarse());
      const GridField coarse = nested ? coarse_beam_on_sphere(beam, g).field
                                      : beam_on_sphere(beam, geometry(Sphere{}, 2.0 * h)).field;
      double error = 0.0;
      Points points(3, static_cast<Eigen::Index>(24 * beam.surface.size()));
      Eigen::Index at = 0;
      double largest = 0.0;
      for (const auto& [z, u] : beam.surface)
        for (int i = 0; i < 24; ++i) {
          const double phi = 2.0 * pi * (i + 0.3) / 24.0, r = std::sqrt(1.0 - z * z);
          const Vec3 x(r * std::cos(phi), r * std::sin(phi), z);
          points.col(at++) = x;
          error += std::pow(fine.value(x, x) - u, 2);
          largest = std::max(largest, u);
        }
      error = std::sqrt(error / static_cast<double>(points.cols())) / largest;
      const GridErrorEstimate estimate = estimate_error(fine, coarse, points, points, lambda * h);
      ++cases;
      above += estimate.rms >= error ? 1 : 0;
      RecordProperty("case" + std::to_string(cases),
                     std::to_string(error) + " / " + std::to_string(estimate.rms));
      EXPECT_GT(estimate.rms, 0.5 * error);
      EXPECT_LT(estimate.rms, 10.0 * error);
    }
  EXPECT_GE(above, cases - 1);
}

INSTANTIATE_TEST_SUITE_P(NestedGrid, EstimateFrom, testing::Bool());

// The same difference stands for a larger error where light decays within a cell.
TEST(ErrorEstimate, IsLargerWhereLightDecaysWithinACell) {
  const auto g = geometry(Sphere{}, 0.2);
  const GridField one(g, Eigen::VectorXd::Ones(g->finest().dofs));
  const GridField half(g, Eigen::VectorXd::Constant(g->finest().dofs, 0.5));
  const Samples s = samples(Sphere{}, 100);
  const auto rms = [&](double cell) {
    return estimate_error(one, half, s.positions, s.normals, cell).rms;
  };
  EXPECT_NEAR(rms(0.0), 0.5 / (std::pow(2.0, 1.3) - 1.0), 1e-9);
  EXPECT_NEAR(rms(1.0), 0.5 / (2.0 - 1.0), 1e-9);  // first order
  EXPECT_GT(rms(3.0), rms(2.0));
}

// A dark object is exact; not a number stays so.
TEST(ErrorEstimate, DarkAndBad) {
  const auto g = geometry(Sphere{}, 0.2);
  const GridField dark(g, Eigen::VectorXd::Zero(g->finest().dofs));
  const Samples s = samples(Sphere{}, 100);
  EXPECT_EQ(estimate_error(dark, dark, s.positions, s.normals, 0.0).rms, 0.0);
  EXPECT_TRUE(std::isnan(estimate_error(GridField(), dark, s.positions, s.normals, 0.0).rms));
}

}  // namespace
}  // namespace knotlight
