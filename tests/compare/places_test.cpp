// Places, truth and slices on shapes where the answer is known.
#include "compare/places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compare/slice.h"
#include "compare/truth.h"

namespace knotlight {
namespace {

PreparedScene scene_of(const Shape& shape, const Medium& medium, const Light& light) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(medium.sigma_a);
  material.sigma_s = Spectrum::Constant(medium.sigma_s);
  material.g = Spectrum::Constant(medium.g);
  Scene scene;
  scene.objects = {{"body", shape, material}};
  scene.lights = {light};
  scene.camera.from = Vec3(0, -5, 0);
  scene.camera.width_px = 40;
  scene.camera.height_px = 30;
  scene.solver.photons = 400'000;
  return prepare_scene(std::move(scene));
}

const Sphere unit_ball{Vec3::Zero(), 1.0};
const DirectionalLight down{Vec3(0, 0, -1), Spectrum::Ones()};

TEST(ComparePlaces, LinesStartWhereTheyAreSaidTo) {
  const PreparedScene prepared = scene_of(unit_ball, {0.1, 10, 0, 1, 0}, down);
  const auto lines = choose_lines(prepared, 0, 1);
  // Light enters with the cosine to the beam: from the top all of it, from below none.
  EXPECT_GT(lines[0].start.z(), 0.97);
  EXPECT_GT(lines[0].entered, 0.97);
  // Half of the light enters above z^2 = 1/2.
  EXPECT_NEAR(lines[1].start.z(), std::sqrt(0.5), 0.03);
  EXPECT_EQ(lines[2].entered, 0.0);
  for (const InwardLine& line : lines) {
    EXPECT_NEAR(line.start.norm(), 1.0, 1e-9);
    EXPECT_NEAR((line.start + line.inward).norm(), 0.0, 1e-9);  // towards the centre
    EXPECT_NEAR(line.length, 12.0 / 10.1, 1e-6);  // 2 would be longer than 12 mean free paths
  }
}

TEST(ComparePlaces, TheCameraSeesTheBall) {
  const PreparedScene prepared = scene_of(unit_ball, {0.1, 10, 0, 1, 0}, down);
  const SeenSurface seen = see_surface(prepared);
  ASSERT_EQ(seen.parts.size(), 1U);
  EXPECT_EQ(seen.most_seen(), 0U);
  // A disc of tangent 1/sqrt(24) in a picture of tangent 20 degrees: 187 of the 1200 pixels' area.
  const double half = 15.0 / std::tan(20.0 * std::numbers::pi / 180.0) / std::sqrt(24.0);
  EXPECT_NEAR(static_cast<double>(seen.pixels()), std::numbers::pi * half * half, 12.0);
  EXPECT_EQ(static_cast<std::size_t>(seen.parts[0].surface.positions.cols()), seen.pixels());
}

// A body that only scatters, in a sky of radiance 1 without refraction, holds U = 1 everywhere. Sum
// over all cells: 60 000 photons enter and scatter, each some 10 times; the spread over seeds is
// about 0.3 %, the bound five of that (false alarms below 1e-6).
TEST(CompareTruth, ASkyFillsABodyThatDoesNotAbsorb) {
  const EnvironmentLight sky{Spectrum::Ones(), nullptr};
  const PreparedScene prepared = scene_of(unit_ball, {0.0, 5.0, 0.3, 1, 0}, sky);
  RunContext run(RunOptions{}, false);
  const TransportTruth truth = trace_truth(prepared, 0, 1e6, 1, run);
  ASSERT_GT(truth.centers.cols(), 1000);
  EXPECT_NEAR((truth.U_d + truth.U_ri).mean(), 1.0, 0.015);
  // Near the centre light has come a mean free path or five: exp(-5) of it unscattered.
  EXPECT_LT(truth.U_ri.minCoeff(), 0.1);
  const auto cells = cells_along({"", Vec3(0, 0, 1), Vec3(0, 0, -1), 2.0, 0.0}, truth);
  ASSERT_GT(cells.size(), 10U);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 x = truth.centers.col(static_cast<Eigen::Index>(cells[i].cell));
    EXPECT_LE(std::hypot(x.x(), x.y()), 0.75 * truth.cell + 1e-12);
    EXPECT_NEAR(cells[i].depth, 1.0 - x.z(), 1e-12);
    if (i > 0) {
      EXPECT_GE(cells[i].depth, cells[i - 1].depth);
    }
  }
}

TEST(CompareTruth, SaysWhereThereIsNone) {
  PreparedScene prepared = scene_of(unit_ball, {0.1, 10, 0, 1, 0}, down);
  EXPECT_EQ(no_truth_because(prepared), "");
  prepared.scene.solver.similarity = true;
  EXPECT_NE(no_truth_because(prepared), "");
  prepared.scene.solver.similarity = false;
  prepared.scene.lights.clear();
  EXPECT_NE(no_truth_because(prepared), "");
  RunContext run(RunOptions{}, false);
  const TransportTruth truth = trace_truth(prepared, 0, 1e6, 1, run);
  EXPECT_GT(truth.centers.cols(), 0);
  EXPECT_TRUE(std::isnan(truth.U_d[0]));
}

// A cube under a beam: -f = 3 sigma_s (sigma_tr + g sigma_t) exp(-sigma_t depth) / (4 pi), ten rows
// of the slice at a time. Some 8000 points lie in the deepest of them: a standard error of 1.1 %,
// the bound is 6 % (false alarms below 1e-6).
TEST(CompareSlice, PhotonsGiveTheSourceOfABeam) {
  const Medium m{0.2, 3.0, 0.4, 1.0, 0.0};
  const PreparedScene prepared = scene_of(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1)), m, down);
  RunContext run(RunOptions{}, false);
  Stage stage(run.stages, "light", 0);
  const auto light =
      trace_incident_light(prepared, 0, SourceModel::photon_map, 1, run.workers, stage);
  const Slice slice = choose_slice(prepared.scene.objects[0], prepared.scene.camera, Vec3::Zero());
  EXPECT_EQ(slice.across, 1);
  const ValueMap map = source_slice(light[0], prepared, 0, slice);
  const double cell = 2.0 / map.height;
  const double top =
      3.0 * m.sigma_s * (m.sigma_tr() + m.g * m.sigma_t()) / (4.0 * std::numbers::pi);
  constexpr int rows = 10;
  for (const int first : {0, 10, 20}) {
    double mean = 0.0;
    double exact = 0.0;
    for (int row = first; row < first + rows; ++row) {
      for (int column = 0; column < map.width; ++column)
        mean += map.values[static_cast<std::size_t>(row * map.width + column)] / map.width;
      exact += top * std::exp(-m.sigma_t() * (row + 0.5) * cell);
    }
    EXPECT_NEAR(mean / exact, 1.0, 0.06) << first;
  }
}

TEST(CompareSlice, SheetsOfPointsLieOneMeanFreePathDeep) {
  const Medium m{0.2, 3.1, 0.4, 1.0, 0.0};
  const PreparedScene prepared = scene_of(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1)), m, down);
  RunContext run(RunOptions{}, false);
  Stage stage(run.stages, "light", 0);
  const auto light =
      trace_incident_light(prepared, 0, SourceModel::irradiance_sampling, 1, run.workers, stage);
  const Slice slice = choose_slice(prepared.scene.objects[0], prepared.scene.camera, Vec3::Zero());
  const ValueMap map = source_slice(light[0], prepared, 0, slice);
  const int expected = static_cast<int>(0.5 * map.height / m.sigma_tr());
  for (int row = 0; row < map.height; ++row) {
    double sum = 0.0;
    for (int column = 0; column < map.width; ++column)
      sum += map.values[static_cast<std::size_t>(row * map.width + column)];
    EXPECT_EQ(sum > 0.0, row == expected) << row;
  }
}

TEST(CompareSlice, Decades) {
  const ValueMap map = decades_below({4, 1, {10.0, 0.1, 0.0, NAN}}, 10.0, -3.0);
  EXPECT_EQ(map.values[0], 0.0);
  EXPECT_NEAR(map.values[1], -2.0, 1e-12);
  EXPECT_EQ(map.values[2], -3.0);
  EXPECT_TRUE(std::isnan(map.values[3]));
}

}  // namespace
}  // namespace knotlight
