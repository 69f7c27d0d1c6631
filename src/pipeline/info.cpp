#include "pipeline/info.h"

#include <fmt/format.h>

#include <algorithm>

#include "photon/photon_tracer.h"
#include "pipeline/plan.h"
#include "pipeline/scene_setup.h"

namespace knotlight {
namespace {

// Fractions are then good to about 0.1 % of the incident power; all orders of more photons would
// keep a user waiting.
constexpr std::size_t most_audit_photons = 200'000;

}  // namespace

Report inspect_scene(const std::string& path, bool audit, RunContext& run, Scene& scene_out) {
  const PreparedScene prepared = prepare_scene(path, run);
  const Scene& scene = prepared.scene;
  const Plan plan = make_plan(prepared);
  Report report;
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const Object& object = scene.objects[prepared.translucent[i]];
    ObjectReport entry;
    entry.name = object.name;
    entry.source = plan.source_reason;
    entry.method = plan.methods[i].reason;
    for (int c = 0; c < scene.channels; ++c)
      entry.validity.push_back(diffusion_validity(object.shape, object.translucent()->medium(c)));
    report.objects.push_back(entry);
  }
  if (audit) {
    TracerOptions options;
    options.photons = std::min(scene.solver.photons, most_audit_photons);
    report.photons_emitted = options.photons;
    options.seed = run.options.seed;
    options.orders = TracerOptions::Orders::all;
    options.store = false;
    Stage stage(run.stages, "photons", options.photons * static_cast<std::size_t>(scene.channels));
    for (int c = 0; c < scene.channels; ++c) {
      const TraceResult result =
          trace_photons(scene, *prepared.caster, c, options, run.workers, stage);
      for (std::size_t i = 0; i < prepared.translucent.size(); ++i)
        report.objects[i].audit.push_back(result.audit[prepared.translucent[i]]);
    }
  }
  scene_out = prepared.scene;
  return report;
}

std::string describe(const Report& report, const Scene& scene) {
  std::string text =
      fmt::format("lengths in {}; {} channel{}; {} light{}; {} photons per channel\n", scene.units,
                  scene.channels, scene.channels == 1 ? "" : "s", scene.lights.size(),
                  scene.lights.size() == 1 ? "" : "s", scene.solver.photons);
  for (const ObjectReport& object : report.objects) {
    text += fmt::format("\n{}\n  {:<9}{:>10}{:>16}{:>20}{:>10}{:>16}  {}\n", object.name, "channel",
                        "size", "mean free paths", "thickness (1/s_tr)", "lambda R",
                        "reduced albedo", "diffusion");
    for (std::size_t c = 0; c < object.validity.size(); ++c) {
      const Validity& v = object.validity[c];
      text += fmt::format("  {:<9}{:>10.4g}{:>16.4g}{:>20.4g}{:>10.4g}{:>16.5g}  {}\n", c, v.size,
                          v.size_in_mean_free_paths, v.thickness, v.lambda_R, v.reduced_albedo,
                          v.valid ? "holds" : "does not hold");
      for (const std::string& reason : v.reasons) text += fmt::format("           {}\n", reason);
    }
    for (std::size_t c = 0; c < object.audit.size(); ++c) {
      const EnergyAudit& a = object.audit[c];
      if (a.photons == 0) continue;
      text += fmt::format(
          "  {:<9}of the light that arrives {:.4f} is reflected, {:.4f} absorbed, {:.4f} escapes "
          "(standard error {:.4f})\n",
          c, a.reflected_fraction(), a.absorbed_fraction(), a.escaped_fraction(),
          a.standard_error_escaped / a.incident);
    }
    text += fmt::format("  source   {}\n  method   {}\n", object.source, object.method);
  }
  return text;
}

}  // namespace knotlight
