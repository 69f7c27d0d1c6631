#include "pipeline/solve_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/convexity.h"
#include "photon/photon_tracer.h"
#include "pipeline/info.h"
#include "pipeline/solve_grid.h"
#include "trace/overlap.h"

namespace knotlight {

namespace {

// Light that has left an object can enter it, or another one, again unless there is but one,
// convex.
bool light_can_come_back(const PreparedScene& prepared) {
  return prepared.translucent.size() > 1 ||
         (prepared.translucent.size() == 1 &&
          !is_convex(prepared.scene.objects[prepared.translucent[0]].shape));
}

// Photons are sent at the sphere around all translucent objects. Whether enough of them were aimed
// at one object's own sphere to tell darkness from bad luck.
bool aimed_at(const PreparedScene& prepared, std::uint32_t object) {
  constexpr double enough = 10'000.0;  // three in so many is the 95 % bound if none was seen
  Bounds all;
  for (const std::uint32_t i : prepared.translucent) {
    const Bounds own = bounds(prepared.scene.objects[i].shape);
    all.extend(own.lo);
    all.extend(own.hi);
  }
  const double share =
      std::pow(bounds(prepared.scene.objects[object].shape).radius() / all.radius(), 2);
  return prepared.scene.lights.empty() ||
         share * static_cast<double>(prepared.scene.solver.photons) >= enough;
}

}  // namespace

SolvedScene solve_scene(const PreparedScene& prepared, RunContext& run) {
  const Scene& scene = prepared.scene;
  const auto channels = static_cast<std::size_t>(scene.channels);

  // photons[channel][object]
  std::vector<std::vector<std::vector<VolumePhoton>>> photons;
  {
    TracerOptions options;
    options.photons = scene.solver.photons;
    options.seed = run.options.seed;
    if (light_can_come_back(prepared)) options.orders = TracerOptions::Orders::reentering;
    Stage stage(run.stages, "photons", options.photons * channels);
    for (int c = 0; c < scene.channels; ++c)
      photons.push_back(
          trace_photons(scene, *prepared.caster, c, options, run.workers, stage).photons);
  }

  std::vector<std::optional<ObjectGrids>> grids(prepared.translucent.size());
  if (chosen_method(scene.solver) == Method::grid) {
    Stage stage(run.stages, "grid", grids.size());
    for (std::size_t i = 0; i < grids.size(); ++i) {
      grids[i] = make_grids(scene.objects[prepared.translucent[i]], scene.channels, scene.solver,
                            run.workers);
      stage.advance();
    }
  }

  // Every (object, channel) is a system of its own; they run side by side, each on one thread,
  // since the dense solver's bits must not depend on the number of threads.
  const std::size_t systems = prepared.translucent.size() * channels;
  std::vector<std::optional<SolvedChannel>> solved(systems);
  {
    Stage stage(run.stages, "solve", systems);
    run.workers.for_chunks(systems, 1, [&](std::size_t system, std::size_t, std::size_t) {
      const std::uint32_t object = prepared.translucent[system / channels];
      const std::size_t channel = system % channels;
      const auto& object_grids = grids[system / channels];
      solved[system] =
          solve_channel(scene, *prepared.caster, object, static_cast<int>(channel),
                        object_grids ? &*object_grids : nullptr,
                        std::move(photons[channel][object]), run.options.seed, Workers(1));
      stage.advance();
    });
  }

  SolvedScene result;
  for (const std::string& inclusion : opaque_inclusions(scene, *prepared.caster))
    result.report.failures.push_back(inclusion + ": the diffusion equation does not know it");
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const Object& object = scene.objects[prepared.translucent[i]];
    ObjectReport report;
    report.name = object.name;
    report.method = planned_method(scene);
    result.objects.emplace_back();
    for (std::size_t c = 0; c < channels; ++c) {
      SolvedChannel& channel = *solved[i * channels + c];
      const std::string where = channels == 1
                                    ? fmt::format("object '{}'", object.name)
                                    : fmt::format("object '{}', channel {}", object.name, c);
      const Validity validity =
          diffusion_validity(object.shape, object.translucent()->medium(static_cast<int>(c)));
      for (const std::string& failure : channel.failures)
        result.report.failures.push_back(fmt::format("{}: {}", where, failure));
      if (!aimed_at(prepared, prepared.translucent[i]) && channel.report.photons == 0)
        result.report.failures.push_back(fmt::format(
            "{}: no photon met it, but hardly any was sent its way: it is small beside the others",
            where));
      if (object.translucent()->emission.maxCoeff() > 0.0 && light_can_come_back(prepared))
        result.report.failures.push_back(fmt::format(
            "{}: light that it emits itself and that comes back to it is not counted", where));
      for (const std::string& reason : validity.reasons)
        result.report.failures.push_back(
            fmt::format("{}: diffusion does not hold: {}", where, reason));
      report.validity.push_back(validity);
      report.channels.push_back(channel.report);
      result.objects.back().push_back(std::move(channel));
    }
    result.report.objects.push_back(report);
  }
  return result;
}

}  // namespace knotlight
