// What a new light costs when the systems are kept: photons and back-substitutions, against a solve
// from nothing.
#include <benchmark/benchmark.h>

#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"

namespace {

using namespace knotlight;

constexpr Method methods[] = {Method::grid, Method::bkm, Method::mfs, Method::lbkm};

PreparedScene ball_under_a_beam(Method method, std::size_t photons, double turned) {
  TranslucentMaterial wax;
  wax.sigma_a = Spectrum::Constant(0.2);
  wax.sigma_s = Spectrum::Constant(9.8);
  Scene scene;
  scene.lights = {
      DirectionalLight{Vec3(std::sin(turned), 0.0, -std::cos(turned)), Spectrum::Ones()}};
  scene.objects = {{"ball", Sphere{Vec3::Zero(), 1.0}, wax}};
  scene.solver.method = method;
  scene.solver.photons = photons;
  return prepare_scene(std::move(scene));
}

// Arguments: index into `methods`, photons, whether the systems are kept.
void new_light(benchmark::State& state) {
  const Method method = methods[state.range(0)];
  const auto photons = static_cast<std::size_t>(state.range(1));
  RunContext run(RunOptions{}, false);
  FactorCache kept;
  double angle = 0.0;
  (void)solve_scene(ball_under_a_beam(method, photons, angle), run, kept);
  for (auto _ : state) {
    const PreparedScene prepared = ball_under_a_beam(method, photons, angle += 0.1);
    FactorCache fresh;
    benchmark::DoNotOptimize(solve_scene(prepared, run, state.range(2) != 0 ? kept : fresh));
  }
  state.SetLabel(std::string(name_of(method)) +
                 (state.range(2) != 0 ? ", kept" : ", from nothing"));
}
BENCHMARK(new_light)
    ->ArgsProduct({{0, 1, 2, 3}, {50'000, 1'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
