// Light of all orders in the cells of a grid against what the transfer equation says without being
// solved: uniform light, the mean path length, Beer's law, the conservation of flux.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/fresnel.h"
#include "photon/photon_scenes.h"
#include "scene/mesh_reader.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::scene_of;
using testing_scenes::sky;
using testing_scenes::slab_beam_area;
using testing_scenes::slab_medium;
using testing_scenes::slab_scene;
using testing_scenes::trace;
using testing_scenes::translucent;
using Orders = TracerOptions::Orders;

constexpr auto collisions = FluxEstimator::collisions;
constexpr auto track_lengths = FluxEstimator::track_lengths;

// Standard errors allowed. They come from 256 batches, so the quotient follows Student's t with 255
// degrees of freedom: beyond 5.5 lies 1e-7 of it, and 2000 checks raise a false alarm once in 5000
// choices of the seed.
constexpr double sigmas = 5.5;

FluxTally tally_of(const Scene& scene, const FluxGrid& grid) {
  return {grid, 0, scene.objects[0].shape, scene.objects[0].translucent()->medium(0)};
}

TraceResult fill(const Scene& scene, FluxTally& tally, std::size_t photons, int threads = 2) {
  return trace(scene, Orders::all, photons, false, threads, 1, {&tally, 1});
}

FluxGrid grid_around(const Shape& shape, const std::array<int, 3>& n) {
  const Bounds b = bounds(shape);
  return {b.lo, b.hi, n};
}

// Uniform light of radiance L around a body that does not absorb: inside the radiance is n^2 L from
// everywhere, so U = n^2 L and F = 0 in every cell, however the surface cuts it. Cells of less than
// `least_volume` see too few photons for their sums to be normal.
void expect_furnace(const Shape& shape, const Medium& medium, const std::array<int, 3>& n,
                    std::size_t photons, double least_volume, double worst_error) {
  const Scene scene = scene_of({sky(1.0)}, {translucent(shape, medium)});
  FluxTally tally = tally_of(scene, grid_around(shape, n));
  fill(scene, tally, photons);
  const double U = medium.ior * medium.ior;
  std::size_t cells = 0;
  std::size_t cut = 0;
  for (std::size_t c = 0; c < tally.grid().cells(); ++c) {
    if (tally.volume(c) < least_volume) continue;
    cells += 1;
    cut += tally.volume(c) < 0.999 * tally.grid().cell_size().prod() ? 1 : 0;
    for (const FluxEstimator estimator : {collisions, track_lengths}) {
      const Flux f = tally.flux(c, FluxOrder::all, estimator);
      EXPECT_NEAR(f.U, U, sigmas * f.U_error) << c;
      EXPECT_LT(f.U_error, worst_error * U) << c;
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(f.F[a], 0.0, sigmas * f.F_error[a]) << c;
    }
  }
  EXPECT_GT(cells, 50U);
  EXPECT_GT(cut, cells / 2);  // that is what it is about
}

TEST(Transport, WhiteFurnaceInATorus) {
  expect_furnace(testing_scenes::torus_mesh(40, 20), {0.0, 5.0, 0.6, 1.0, 0.0}, {7, 7, 3}, 200'000,
                 1e-3, 0.1);
}

TEST(Transport, WhiteFurnaceInARefractingBall) {
  expect_furnace(Sphere{Vec3(1, 2, 3), 1.0}, {0.0, 4.0, 0.0, 1.4, 0.0}, {5, 5, 5}, 100'000, 1e-3,
                 0.1);
}

// Index-matched, without absorption, under uniform light: the mean length of the whole path inside
// is 4V/S, scattering or not [BF03]. The lengths of all paths in W length are 4 pi U V of one cell
// around everything; what arrives (again, too: once more per visit) is known to be pi L S.
void expect_mean_path(const Shape& shape, double sigma_s, double g, std::size_t photons) {
  const Scene scene = scene_of({sky(1.0)}, {translucent(shape, {0.0, sigma_s, g, 1.0, 0.0})});
  FluxGrid grid = grid_around(shape, {1, 1, 1});
  grid.hi += 1e-9 * Vec3::Ones();  // half-open: the upper faces too
  FluxTally tally = tally_of(scene, grid);
  const TraceResult r = fill(scene, tally, photons);
  EXPECT_NEAR(tally.volume(0), volume(shape), 1e-9 * volume(shape));
  const Flux f = tally.flux(0, FluxOrder::all, track_lengths);
  const double paths = 4.0 * pi * f.U * tally.volume(0);
  const double exact = 4.0 * volume(shape) / surface_area(shape);
  // The errors of the two sums, taken as if they always added.
  const double relative_error =
      f.U_error / f.U + r.audit[0].standard_error_incident / r.audit[0].incident;
  EXPECT_NEAR(paths / r.audit[0].incident, exact, sigmas * relative_error * exact);
  EXPECT_NEAR(paths, exact * pi * surface_area(shape), sigmas * f.U_error / f.U * paths);
  EXPECT_LT(relative_error, 0.02);
  EXPECT_LT(r.audit[0].lost, 1e-5 * r.audit[0].incident);
}

TEST(Transport, MeanPathLengthInATorus) {
  const Shape torus = testing_scenes::torus_mesh(40, 20);
  expect_mean_path(torus, 0.3, 0.0, 60'000);
  expect_mean_path(torus, 8.0, 0.8, 60'000);
}

TEST(Transport, MeanPathLengthInTheKnot) {
  std::vector<std::string> warnings;
  const Shape knot =
      make_solid(read_mesh(std::string(KNOTLIGHT_ROOT) + "/scenes/meshes/knot.ply"), warnings);
  const double width = 4.0 * volume(knot) / surface_area(knot);
  expect_mean_path(knot, 0.3 / width, 0.0, 60'000);
  expect_mean_path(knot, 6.0 / width, 0.0, 60'000);
}

// Bins across the slab of slab_scene, wide enough to hold all of its light: what they say of the
// whole box times this is the plane wave's answer.
constexpr double box_per_beam = 400.0 * 400.0 / slab_beam_area;
FluxGrid slab_bins(int n) {
  return {Vec3(-200, -200, 0), Vec3(200, 200, 1), {1, 1, n}};
}

// Beer's law with the light that both faces throw back: of irradiance 1, (1-R) comes in, and with
// e = exp(-b) the light that goes down and up again sums to
//   down(z) = (1-R) exp(-b (1-z)) / (1 - R^2 e^2),   up(z) = R e down's entry exp(-b z).
TEST(Transport, UnscatteredLightByBothEstimators) {
  for (const double ior : {1.0, 1.4}) {
    constexpr double b = 2.0;
    const Scene scene = slab_scene(slab_medium(b, 0.6, 0.3, ior));
    constexpr int bins = 10;
    FluxTally tally = tally_of(scene, slab_bins(bins));
    fill(scene, tally, 200'000);
    const double R = fresnel_reflectance(1.0, ior);
    const double down = (1.0 - R) / (1.0 - R * R * std::exp(-2.0 * b));
    const double up = R * std::exp(-b) * down;
    for (int k = 0; k < bins; ++k) {
      const double h = 1.0 / bins;
      const double mean = (1.0 - std::exp(-b * h)) / (b * h);  // of exp(-b s) over a bin
      const double goes_down = down * std::exp(-b * (1.0 - h * (k + 1))) * mean;
      const double goes_up = up * std::exp(-b * h * k) * mean;
      for (const FluxEstimator estimator : {collisions, track_lengths}) {
        const Flux f = tally.flux(static_cast<std::size_t>(k), FluxOrder::unscattered, estimator);
        EXPECT_NEAR(box_per_beam * f.U, (goes_down + goes_up) / (4.0 * pi),
                    sigmas * box_per_beam * f.U_error);
        EXPECT_NEAR(box_per_beam * f.F.z(), goes_up - goes_down,
                    sigmas * box_per_beam * f.F_error.z());
        EXPECT_LT(f.U_error, 0.03 * f.U);
        const Flux c = tally.flux(static_cast<std::size_t>(k), FluxOrder::all, collisions);
        const Flux t = tally.flux(static_cast<std::size_t>(k), FluxOrder::all, track_lengths);
        EXPECT_NEAR(c.U, t.U, sigmas * std::hypot(c.U_error, t.U_error));
        EXPECT_NEAR(c.F.z(), t.F.z(), sigmas * std::hypot(c.F_error.z(), t.F_error.z()));
      }
    }
  }
}

// Without absorption div F = 0: the flux through a slab is -T at every depth, light of order 0,
// which dies out, and scattered light together.
TEST(Transport, FluxIsConserved) {
  for (const double ior : {1.0, 1.4}) {
    const Scene scene = slab_scene(slab_medium(5.0, 1.0, 0.5, ior));
    constexpr std::size_t bins = 8;
    FluxTally tally = tally_of(scene, slab_bins(bins));
    const TraceResult r = fill(scene, tally, 150'000);
    const double T = r.audit[1].incident / r.audit[0].incident;
    const double T_error = std::sqrt(T * (1.0 - T) / static_cast<double>(r.audit[0].photons));
    for (std::size_t k = 0; k < bins; ++k) {
      for (const FluxEstimator estimator : {collisions, track_lengths}) {
        const Flux f = tally.flux(k, FluxOrder::all, estimator);
        EXPECT_NEAR(box_per_beam * f.F.z(), -T, sigmas * (box_per_beam * f.F_error.z() + T_error));
        EXPECT_LT(box_per_beam * f.F_error.z(), 0.05);
        for (const int side : {0, 1}) EXPECT_NEAR(f.F[side], 0.0, sigmas * f.F_error[side]);
      }
    }
  }
}

// With absorption the divergence theorem: the difference of the mean flux between the uppermost and
// the lowest of n layers is what is absorbed in between,
//   F_top - F_bottom = -4 pi sigma_a int U(z) m(z) dz,
// m(z) = how far the mean over a layer has moved past z: 0 to 1 through the lowest, 1, 1 to 0.
TEST(Transport, FluxAndAbsorptionBalance) {
  const Medium medium = slab_medium(4.0, 0.8, 0.6, 1.4);
  const Scene scene = slab_scene(medium);
  constexpr int layers = 4;
  constexpr int bins_per_layer = 10;
  FluxTally coarse = tally_of(scene, slab_bins(layers));
  FluxTally fine = tally_of(scene, slab_bins(layers * bins_per_layer));
  fill(scene, coarse, 200'000);
  fill(scene, fine, 200'000);
  for (const FluxEstimator estimator : {collisions, track_lengths}) {
    const Flux top = coarse.flux(layers - 1, FluxOrder::all, estimator);
    const Flux bottom = coarse.flux(0, FluxOrder::all, estimator);
    double absorbed = 0.0;
    double absorbed_error = 0.0;  // as if errors always added
    for (int k = 0; k < layers * bins_per_layer; ++k) {
      const double z = (k + 0.5) / bins_per_layer;
      const double m = std::min({z, 1.0, layers - z});
      const Flux f = fine.flux(static_cast<std::size_t>(k), FluxOrder::all, estimator);
      const double per_U = 4.0 * pi * medium.sigma_a * m / (layers * bins_per_layer);
      absorbed += per_U * f.U;
      absorbed_error += per_U * f.U_error;
    }
    // U bends little over a fortieth of the slab: replacing it by its means errs by 1e-3 of it.
    constexpr double bins_error = 1e-3;
    // Light runs down, z up: less of it at the bottom.
    EXPECT_NEAR(
        box_per_beam * (bottom.F.z() - top.F.z()), box_per_beam * absorbed,
        sigmas * box_per_beam * std::hypot(top.F_error.z() + bottom.F_error.z(), absorbed_error) +
            bins_error);
    EXPECT_GT(box_per_beam * absorbed, 0.2);
  }
}

// Light that left a concave object and meets it again is unscattered again. Index-matched, what
// arrives, again or not, either interacts at order 0 or escapes unscattered, photon by photon.
TEST(Transport, LightThatComesBackStartsAtOrderZero) {
  const Shape torus = testing_scenes::torus_mesh(40, 20);
  const Scene scene = scene_of({sky(1.0)}, {translucent(torus, {0.0, 3.0, 0.0, 1.0, 0.0})});
  FluxGrid grid = grid_around(torus, {1, 1, 1});
  grid.hi += 1e-9 * Vec3::Ones();  // half-open: the upper faces too
  FluxTally tally = tally_of(scene, grid);
  const EnergyAudit a = fill(scene, tally, 20'000).audit[0];
  const double interacting =
      4.0 * pi * 3.0 * tally.volume(0) * tally.flux(0, FluxOrder::unscattered, collisions).U;
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(interacting, a.incident - a.escaped_unscattered - a.lost, rounding * a.incident);
}

TEST(Transport, SameBitsForAnyNumberOfThreads) {
  const Scene scene =
      scene_of({sky(0.5)}, {translucent(Sphere{Vec3(0, 0, 0), 1.0}, {0.1, 3.0, 0.5, 1.3, 0.0})});
  const FluxGrid grid = grid_around(scene.objects[0].shape, {3, 3, 3});
  FluxTally one = tally_of(scene, grid);
  FluxTally three = tally_of(scene, grid);
  fill(scene, one, 20'000, 1);
  fill(scene, three, 20'000, 3);
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    for (const FluxEstimator estimator : {collisions, track_lengths}) {
      const Flux a = one.flux(c, FluxOrder::all, estimator);
      const Flux b = three.flux(c, FluxOrder::all, estimator);
      EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << c;
      EXPECT_GT(a.U, 0.0);
    }
  }
}

}  // namespace
}  // namespace knotlight
