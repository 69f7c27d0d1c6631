// What the viewer has to keep up with on scenes/knot.yaml: frames of an orbit (20 a second are
// wanted at 640 x 480), and a light that is moved (0.5 s to the next picture's field).
#include <benchmark/benchmark.h>

#include <condition_variable>
#include <mutex>

#include "scene/scene_reader.h"
#include "view/display.h"
#include "view/orbit.h"
#include "view/picture_thread.h"

namespace {

using namespace knotlight;

Scene knot() {
  return read_scene(std::string(KNOTLIGHT_ROOT) + "/scenes/knot.yaml");
}

std::shared_ptr<const SolvedView> solved(const Scene& scene, FactorCache& factors) {
  RunContext run(RunOptions{}, false);
  Scene preview = scene;
  preview.solver = preview_of(scene.solver, PreviewSettings{});
  return solve_view(std::move(preview), Quality::preview, run, factors);
}

// From the mouse's word to bytes for the screen, as the window does it: the first picture after
// every step of the camera.
void orbit_frame(benchmark::State& state) {
  FactorCache factors;
  const auto view = solved(knot(), factors);
  std::mutex mutex;
  std::condition_variable shown;
  PictureThread thread(1, 0, [&] {
    const std::lock_guard lock(mutex);
    shown.notify_all();
  });
  Camera camera = fitted(view->prepared->scene.camera, static_cast<int>(state.range(0)),
                         static_cast<int>(state.range(1)));
  double strides = 0.0;
  for (auto _ : state) {
    camera = orbited(camera, 0.01, 0.0);
    thread.show({view, camera, nullptr, 1, 0});
    std::shared_ptr<const PictureFrame> frame;
    std::unique_lock lock(mutex);
    shown.wait(lock, [&] {
      frame = thread.frame();
      return frame && frame->wish.camera.from == camera.from;
    });
    benchmark::DoNotOptimize(tone_mapped_bytes(frame->image, 1.0));
    strides += frame->stride;
  }
  state.counters["frames/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["stride"] = strides / static_cast<double>(state.iterations());
}
BENCHMARK(orbit_frame)
    ->Args({640, 480})
    ->Args({960, 720})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// Rays a second of a whole picture, one sample per pixel: 0 = the look in motion, 1 = at rest.
void full_pass(benchmark::State& state) {
  FactorCache factors;
  const auto view = solved(knot(), factors);
  const Look& look = state.range(0) == 0 ? view->look_in_motion() : view->look;
  Accumulation picture(view->prepared->scene.camera, 1);
  const Workers workers;
  for (auto _ : state)
    picture.add_pass([&](const Ray& ray, Rng& rng) { return look.shading->radiance(ray, rng); },
                     workers);
  state.SetItemsProcessed(state.iterations() * 640 * 480);
}
BENCHMARK(full_pass)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// A light is moved: preview with kept factors (0), or from nothing (1, as after a new material).
void moved_light(benchmark::State& state) {
  Scene scene = knot();
  FactorCache kept;
  (void)solved(scene, kept);
  for (auto _ : state) {
    std::get<AreaLight>(scene.lights[0]).center.x() += 0.01;
    FactorCache fresh;
    benchmark::DoNotOptimize(solved(scene, state.range(0) == 0 ? kept : fresh));
  }
}
BENCHMARK(moved_light)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
