#include "pipeline/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.h"
#include "pipeline/incident_light.h"
#include "pipeline/solve_grid.h"
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
constexpr double least_albedo = 0.99;        // reduced
constexpr double least_p1_thickness = 10.0;  // 4V/S in transport mean free paths

bool diffuse_enough(const PreparedScene& prepared) {
  const Object& object = prepared.scene.objects[prepared.translucent[0]];
  for (int c = 0; c < prepared.scene.channels; ++c) {
    const Medium medium = object.translucent()->medium(c);
    const Validity validity = diffusion_validity(object.shape, medium);
    if (medium.ior != 1.0 || validity.reduced_albedo < least_albedo ||
        validity.thickness < least_p1_thickness)
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
  if (scene.solver.diffusion.value_or(Diffusion::p1) == Diffusion::p1 && sky_alone(scene) &&
      scene.objects.size() == 1 && !light_can_come_back(prepared) && diffuse_enough(prepared)) {
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

const char* what_it_does(Method method) {
  switch (method) {
    case Method::bkm_thesis:
      return "bkm_thesis: dual reciprocity with radial functions and the non-singular solution";
    case Method::bkm:
      return "bkm: photons in closed form with their Robin images, the rest by non-singular "
             "solutions about knots on the whole surface";
    case Method::mfs:
      return "mfs: photons in closed form with their Robin images, the rest by sources outside";
    case Method::lbkm:
      return "lbkm: photons in closed form with their Robin images, the rest by small boundary "
             "knot "
             "problems in overlapping patches";
    case Method::automatic:
    case Method::grid:
      return "grid: finite elements cut off at the surface, sources counted into cells";
  }
  return "";
}

// Cells somewhat larger than wanted still do: the error grows as their square, and the rule has a
// factor of two in hand (docs/results/bars.md).
constexpr double larger_cells_allowed = 1.35;

MethodChoice choose_method(const PreparedScene& prepared, SourceModel source,
                           std::uint32_t object) {
  const auto because = [](Method method, const std::string& reason) {
    return MethodChoice{method, fmt::format("{} (auto: {})", what_it_does(method), reason)};
  };
  if (source == SourceModel::irradiance_thesis)
    return because(Method::bkm_thesis, "the one method that takes values at knots");
  const Scene& scene = prepared.scene;
  const CellSize cells = grid_cell_size(scene.objects[object], scene.channels, scene.solver);
  const double larger = cells.h / cells.wanted;
  if (larger <= larger_cells_allowed)
    return because(Method::grid,
                   "its cells of the size needed are affordable, and it is then the "
                   "fastest");
  return {Method::automatic,
          fmt::format("bkm, or lbkm where bkm's residual is too large (auto: the cells of a grid "
                      "would have to be {:.1f} times as large as needed)",
                      larger)};
}

void check_source(SourceModel source, Method method) {
  if (source == SourceModel::irradiance_thesis && method != Method::bkm_thesis)
    throw InputError(
        fmt::format("solver.source: irradiance_thesis gives values at knots, which {} does not "
                    "have, expected solver.method bkm_thesis with it",
                    name_of(method)));
  if (source == SourceModel::irradiance_sampling && method == Method::bkm_thesis)
    throw InputError(
        "solver.source: irradiance_sampling gives points of power, which dual reciprocity cannot "
        "interpolate, expected another solver.method with it");
}

}  // namespace

const char* name_of(Method method) {
  switch (method) {
    case Method::automatic:
      return "auto";
    case Method::bkm_thesis:
      return "bkm_thesis";
    case Method::bkm:
      return "bkm";
    case Method::mfs:
      return "mfs";
    case Method::lbkm:
      return "lbkm";
    case Method::grid:
      return "grid";
  }
  return "";
}

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
  if (settings.method != Method::automatic) check_source(plan.source, settings.method);
  for (const std::uint32_t object : prepared.translucent)
    plan.methods.push_back(settings.method == Method::automatic
                               ? choose_method(prepared, plan.source, object)
                               : MethodChoice{settings.method, what_it_does(settings.method)});
  return plan;
}

const char* name_of(Exitance exitance) {
  switch (exitance) {
    case Exitance::gather:
      return "gather";
    case Exitance::p1:
      return "p1";
    case Exitance::lambert:
      return "lambert";
    case Exitance::mean_intensity:
      return "mean_intensity";
  }
  return "";
}

}  // namespace knotlight
