// Photons per second on one thread beside the bare ray casts they need; the kd-tree; the estimates.
#include <benchmark/benchmark.h>

#include <numbers>

#include "../photon/photon_scenes.h"
#include "core/sampling.h"
#include "photon/ball_volume.h"
#include "photon/photon_map.h"

namespace {

using namespace knotlight;
using testing_scenes::caster_of;
using testing_scenes::torus_mesh;
using testing_scenes::trace;

// A torus of 6400 triangles, 20 mean free paths across the tube's radius, lit by a distant light.
const Medium medium{0.57, 56.57, 0.0, 1.3, 0.0};
Scene torus_scene() {
  return testing_scenes::scene_of({testing_scenes::parallel_light(Vec3(0.3, 0.2, -1), 1.0)},
                                  {testing_scenes::translucent(torus_mesh(80, 40), medium)});
}

// cells: per axis of a grid of fluxes around the torus; 0 = none.
void trace_benchmark(benchmark::State& state, TracerOptions::Orders orders, bool store,
                     int cells = 0) {
  const Scene scene = torus_scene();
  constexpr std::size_t photons = 50'000;
  std::vector<FluxTally> fluxes;
  if (const Bounds b = bounds(scene.objects[0].shape); cells > 0)
    fluxes.emplace_back(FluxGrid{b.lo, b.hi, {cells, cells, cells}}, 0, scene.objects[0].shape,
                        medium);
  double arrived = 0.0;
  double interactions = 0.0;  // per arrived photon
  for (auto _ : state) {
    const TraceResult r = trace(scene, orders, photons, store, 1, 1, fluxes);
    arrived += static_cast<double>(r.audit[0].photons);
    interactions = r.audit[0].interactions / r.audit[0].incident;
  }
  state.counters["emitted/s"] = benchmark::Counter(
      photons * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["arrived/s"] = benchmark::Counter(arrived, benchmark::Counter::kIsRate);
  state.counters["interactions/s"] =
      benchmark::Counter(arrived * interactions, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(trace_benchmark, first_order, TracerOptions::Orders::first, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trace_benchmark, all_orders, TracerOptions::Orders::all, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trace_benchmark, fluxes_in_one_cell, TracerOptions::Orders::all, false, 1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trace_benchmark, fluxes_in_32_cubed_cells, TracerOptions::Orders::all, false, 32)
    ->Unit(benchmark::kMillisecond);

// Rays from inside in random directions, as long as given: a photon's free flights are short.
void bare_rays(benchmark::State& state) {
  const Scene scene = torus_scene();
  const auto caster = caster_of(scene);
  const double t_max = state.range(0) > 0 ? 1.0 / medium.sigma_t() : 100.0;
  Rng rng(1, Stream::tests, 0);
  for (auto _ : state) {
    const double u = rng.uniform();
    const double v = rng.uniform();
    const double a = 2.0 * std::numbers::pi * rng.uniform();
    benchmark::DoNotOptimize(
        caster->nearest({Vec3(std::cos(a), std::sin(a), 0.0), sample_sphere(u, v), t_max}));
  }
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(bare_rays)->ArgName("short")->Arg(0)->Arg(1);

// The flights between interactions that photons of all orders made, cast again and nothing else:
// what the walk could reach at best.
void bare_flights(benchmark::State& state) {
  const Scene scene = torus_scene();
  const auto caster = caster_of(scene);
  const std::vector<VolumePhoton> photons =
      trace(scene, TracerOptions::Orders::all, 20'000, true).photons[0];
  std::vector<Ray> flights;
  for (std::size_t i = 1; i < photons.size(); ++i)
    if (photons[i].order == photons[i - 1].order + 1 && photons[i - 1].order > 0)
      flights.push_back({photons[i - 1].position, photons[i].direction,
                         (photons[i].position - photons[i - 1].position).norm()});
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(caster->nearest(flights[i]));
    if (++i == flights.size()) i = 0;
  }
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(bare_flights);

void build_tree(benchmark::State& state) {
  const std::vector<VolumePhoton> photons =
      trace(torus_scene(), TracerOptions::Orders::first, 1'000'000, true).photons[0];
  for (auto _ : state) benchmark::DoNotOptimize(VolumePhotonMap(photons, medium).size());
  state.counters["photons/s"] = benchmark::Counter(
      static_cast<double>(photons.size() * state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(build_tree)->Unit(benchmark::kMillisecond);

// Estimates on the surface (the volume of the ball takes rays) and 1 mean free path inside.
void estimates(benchmark::State& state) {
  const Scene scene = torus_scene();
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, TracerOptions::Orders::first, 1'000'000, true).photons[0],
                            medium);
  const bool inside = state.range(0) > 0;
  const auto points =
      stratified_surface_points(scene.objects[0].shape, 2000, true, 1, Stream::boundary_knots);
  std::size_t i = 0;
  for (auto _ : state) {
    const SurfacePoint& p = points[i++ % points.size()];
    const Vec3 x = p.position - (inside ? 1.0 / medium.sigma_t() : 0.0) * p.normal;
    benchmark::DoNotOptimize(map.estimate(x, {}, *caster, 0));
  }
  state.counters["estimates/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(estimates)->ArgName("inside")->Arg(0)->Arg(1);

}  // namespace
