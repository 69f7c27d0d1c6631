// The photon sum: charges put in order a second, points a second and how they fall with the number
// of charges, single interactions a second. The first two with all threads, the last with one.
//
//   photon_sum_bench --benchmark_counters_tabular=true
//
// range(0): thousand charges, each with its Robin image (some 6 charges in all). `points` has 50
// 000 points on the surface, whatever the charges: they crowd around each point as they grow.
// `growth` has 50 points for each thousand charges: points/s times log n should hold still.
#include <benchmark/benchmark.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bkm/charge_cluster.h"
#include "bkm/charge_lanes.h"
#include "bkm/photon_sum.h"
#include "core/rng.h"

namespace knotlight {
namespace {

constexpr double lambda = 3.5, k = 0.033;  // 20 mean free paths, albedo 0.99
constexpr double sigma_t = 20.0;

// A sphere under a beam.
PointSources photons(Eigen::Index count) {
  Rng rng(1, Stream::tests, 0);
  PointSources s;
  s.positions.resize(3, count);
  s.strengths.setConstant(count, 1.0 / static_cast<double>(count));
  s.plane_points.resize(3, count);
  s.clear_heights.setConstant(count, std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < count; ++i) {
    const double r2 = rng.uniform();
    const double phi = 2.0 * std::numbers::pi * rng.uniform();
    const Vec3 entry(std::sqrt(r2) * std::cos(phi), std::sqrt(r2) * std::sin(phi),
                     std::sqrt(1.0 - r2));
    Vec3 p = entry + std::log(1.0 - rng.uniform()) / sigma_t * Vec3::UnitZ();
    if (p.norm() > 1.0) p = entry;
    s.positions.col(i) = p;
    s.plane_points.col(i) = p.normalized();
  }
  s.plane_normals = s.plane_points;
  return s;
}

Points surface_points(Eigen::Index count) {
  Rng rng(2, Stream::tests, 0);
  Points x(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double z = 2.0 * rng.uniform() - 1.0;
    const double phi = 2.0 * std::numbers::pi * rng.uniform();
    const double s = std::sqrt(1.0 - z * z);
    x.col(i) = Vec3(s * std::cos(phi), s * std::sin(phi), z);
  }
  return x;
}

benchmark::Counter per_second(double amount) {
  return {amount, benchmark::Counter::kIsIterationInvariantRate};
}

void build(benchmark::State& state) {
  const Workers workers;
  const PointSources sources = photons(1000 * state.range(0));
  std::size_t charges = 0;
  for (auto _ : state) charges = PhotonSum(sources, lambda, k, {}, workers).charges();
  state.counters["charges/s"] = per_second(static_cast<double>(charges));
}

void evaluate(benchmark::State& state, Eigen::Index count) {
  const Workers workers;
  const PhotonSum sum(photons(1000 * state.range(0)), lambda, k, {}, workers);
  const Points x = surface_points(count);
  PhotonSumValues values;
  for (auto _ : state) values = sum.evaluate(x, &x, workers);
  const double n = static_cast<double>(count);
  const double charges = static_cast<double>(sum.charges());
  state.counters["points/s"] = per_second(n);
  state.counters["points/s log n"] = per_second(n * std::log2(charges));
  state.counters["direct/point"] = static_cast<double>(values.direct_interactions) / n;
  state.counters["clusters/point"] = static_cast<double>(values.cluster_interactions) / n;
  state.counters["pairs/s"] = per_second(n * charges);  // that brute force would have to do
}

void points(benchmark::State& state) {
  evaluate(state, 50'000);
}

void growth(benchmark::State& state) {
  evaluate(state, 50 * state.range(0));
}

// range(0) = 1: with normal derivatives.
void interactions(benchmark::State& state) {
  Rng rng(3, Stream::tests, 0);
  const auto number = [&] { return static_cast<float>(rng.uniform()); };
  std::vector<DirectCharge> charges(128);
  for (DirectCharge& charge : charges) charge = {number(), number(), number(), 1.0F};
  LanePoints at;
  for (int i = 0; i < lane_count; ++i) {
    at.x[i] = number();
    at.y[i] = number();
    at.z[i] = 1.0F + number();
    at.nx[i] = at.ny[i] = 0.0F;
    at.nz[i] = 1.0F;
  }
  LaneSums sums{};
  for (auto _ : state) {
    add_charges(at, charges.data(), 128, 1.0F, {}, state.range(0) == 1, sums);
    benchmark::DoNotOptimize(sums);
  }
  state.counters["interactions/s"] = per_second(128.0 * lane_count);
}

// range(0): degree; with normal derivatives.
void expansions(benchmark::State& state) {
  const std::vector<float> coefficients(cluster_terms, 0.1F);
  LanePoints at;
  for (int i = 0; i < lane_count; ++i) {
    at.x[i] = at.y[i] = 1.0F + 0.1F * static_cast<float>(i);
    at.z[i] = 2.0F;
    at.nx[i] = at.ny[i] = 0.0F;
    at.nz[i] = 1.0F;
  }
  LaneSums sums{};
  for (auto _ : state) {
    add_cluster(at, coefficients.data(), static_cast<int>(state.range(0)), 0.5F, true, sums);
    benchmark::DoNotOptimize(sums);
  }
  state.counters["interactions/s"] = per_second(lane_count);
}

BENCHMARK(build)->Arg(100)->Arg(1000)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(points)->Arg(100)->Arg(300)->Arg(1000)->Arg(2000)->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(growth)->Arg(30)->Arg(100)->Arg(300)->Arg(1000)->Arg(3000)->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(interactions)->Arg(0)->Arg(1);
BENCHMARK(expansions)->Arg(0)->Arg(2)->Arg(4)->Arg(6);

}  // namespace
}  // namespace knotlight
