#include "pipeline/solve_scene.h"

#include <fmt/format.h>

#include <optional>

#include "photon/photon_tracer.h"
#include "pipeline/info.h"
#include "pipeline/solve_grid.h"

namespace knotlight {

SolvedScene solve_scene(const PreparedScene& prepared, RunContext& run) {
  const Scene& scene = prepared.scene;
  const auto channels = static_cast<std::size_t>(scene.channels);

  // photons[channel][object]
  std::vector<std::vector<std::vector<VolumePhoton>>> photons;
  {
    TracerOptions options;
    options.photons = scene.solver.photons;
    options.seed = run.options.seed;
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
