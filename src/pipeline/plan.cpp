#include "pipeline/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.h"
#include "pipeline/incident_light.h"
#include "pipeline/validity.h"

namespace knotlight {
namespace {

bool sky_alone(const Scene& scene) {
  return !scene.lights.empty() &&
         std::all_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
           const auto* sky = std::get_if<EnvironmentLight>(&light);
           return sky != nullptr && sky->map == nullptr;
         });
}

// Where boundary_flux was found as good as the photon map (docs/results/source-models.md).
constexpr double least_albedo = 0.99;     // reduced
constexpr double least_thickness = 10.0;  // 4V/S in transport mean free paths

bool diffuse_enough(const PreparedScene& prepared) {
  const Object& object = prepared.scene.objects[prepared.translucent[0]];
  for (int c = 0; c < prepared.scene.channels; ++c) {
    const Medium medium = object.translucent()->medium(c);
    const Validity validity = diffusion_validity(object.shape, medium);
    if (medium.ior != 1.0 || validity.reduced_albedo < least_albedo ||
        validity.thickness < least_thickness)
      return false;
  }
  return true;
}

void choose_source(const PreparedScene& prepared, Plan& plan) {
  const Scene& scene = prepared.scene;
  if (scene.solver.source) {
    plan.source = *scene.solver.source;
    plan.source_reason = fmt::format("{}, as the scene asks", name_of(plan.source));
    return;
  }
  if (sky_alone(scene) && scene.objects.size() == 1 && !light_can_come_back(prepared) &&
      diffuse_enough(prepared)) {
    plan.source = SourceModel::boundary_flux;
    plan.source_reason =
        "boundary_flux: all light comes evenly from the sky on one convex, index-matched, thick "
        "object that absorbs little; taken as diffuse at once it is as near to transport as with "
        "photons";
    return;
  }
  plan.source = SourceModel::photon_map;
  plan.source_reason =
      "photon_map: models without volume photons are off by 4 % and more where light is not an "
      "even sky, and save little";
}

}  // namespace

const char* name_of(SourceModel model) {
  switch (model) {
    case SourceModel::photon_map:
      return "photon_map";
    case SourceModel::irradiance_sampling:
      return "irradiance_sampling";
    case SourceModel::irradiance_thesis:
      return "irradiance_thesis";
    case SourceModel::boundary_flux:
      return "boundary_flux";
  }
  return "";
}

Plan make_plan(const PreparedScene& prepared) {
  const SolverSettings& settings = prepared.scene.solver;
  Plan plan;
  choose_source(prepared, plan);
  const bool asked = settings.method != Method::automatic;
  if (asked) {
    plan.method = settings.method;
  } else {
    plan.method = plan.source == SourceModel::irradiance_thesis ? Method::bkm_thesis : Method::grid;
  }
  if (plan.method == Method::grid && plan.source == SourceModel::irradiance_thesis)
    throw InputError(
        "solver.source: irradiance_thesis gives values at knots, which grid does not have, "
        "expected "
        "solver.method bkm_thesis with it");
  if (plan.method == Method::bkm_thesis && plan.source == SourceModel::irradiance_sampling)
    throw InputError(
        "solver.source: irradiance_sampling gives points of power, which dual reciprocity cannot "
        "interpolate, expected solver.method grid with it");
  plan.method_reason =
      plan.method == Method::bkm_thesis
          ? "bkm_thesis: dual reciprocity with Gaussians and the non-singular solution, both by "
            "truncated SVD"
          : "grid: finite elements cut off at the surface, sources counted into cells";
  if (!asked)
    plan.method_reason += plan.method == Method::bkm_thesis
                              ? " (auto: the one method that takes values at knots)"
                              : " (auto: the boundary knot method of this version is the thesis's, "
                                "which misses the tolerance on most scenes)";
  return plan;
}

}  // namespace knotlight
