// The dipole's tree: samples put in order a second, and places evaluated a second as the number of
// samples grows. One thread. `evaluate`: points/s should fall as the logarithm of the number of
// samples, `brute_force` as the number itself.
//
//   rivals_bench --benchmark_counters_tabular=true
//
// range(0): thousand samples.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/rng.h"
#include "core/sampling.h"
#include "rivals/dipole.h"

namespace knotlight {
namespace {

constexpr auto per_second = benchmark::Counter::kIsIterationInvariantRate;

// A sphere under a beam, lit on one side.
std::vector<EnteringLight> samples(std::int64_t count) {
  Rng rng(1, Stream::tests, 0);
  std::vector<EnteringLight> points;
  const double area = 4.0 * std::numbers::pi / static_cast<double>(count);
  for (std::int64_t i = 0; i < count; ++i) {
    const double u = rng.uniform();
    const Vec3 x = sample_sphere(u, rng.uniform());
    points.push_back({x, area, area * std::max(0.0, x.z())});
  }
  return points;
}

// 20 samples per square of a mean free path, however many they are.
DipoleKernel kernel_for(std::int64_t count) {
  const double sigma_t = std::sqrt(static_cast<double>(count) / (20.0 * 4.0 * std::numbers::pi));
  return dipole_kernel({0.01 * sigma_t, 0.99 * sigma_t, 0.0, 1.0, 0.0}, DipoleForm::classic);
}

void build(benchmark::State& state) {
  const auto points = samples(1000 * state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(IrradianceTree(points).power());
  state.counters["samples/s"] =
      benchmark::Counter(1e3 * static_cast<double>(state.range(0)), per_second);
}
BENCHMARK(build)->RangeMultiplier(4)->Range(4, 1024)->Unit(benchmark::kMillisecond);

void sum_over_places(benchmark::State& state, double solid_angle) {
  const IrradianceTree tree(samples(1000 * state.range(0)));
  const DipoleKernel kernel = kernel_for(1000 * state.range(0));
  constexpr int places = 64;
  Rng rng(2, Stream::tests, 0);
  std::vector<Vec3> at;
  for (int i = 0; i < places; ++i) {
    const double u = rng.uniform();
    at.push_back(sample_sphere(u, rng.uniform()));
  }
  for (auto _ : state)
    for (const Vec3& x : at) benchmark::DoNotOptimize(tree.exitance(x, kernel, solid_angle));
  state.counters["points/s"] = benchmark::Counter(places, per_second);
}

void evaluate(benchmark::State& state) {
  sum_over_places(state, DipoleSettings().solid_angle);
}
BENCHMARK(evaluate)->RangeMultiplier(4)->Range(4, 1024)->Unit(benchmark::kMillisecond);

void brute_force(benchmark::State& state) {
  sum_over_places(state, 0.0);
}
BENCHMARK(brute_force)->RangeMultiplier(4)->Range(4, 64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace knotlight
