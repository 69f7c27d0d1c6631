#include "view/solved_view.h"

#include <algorithm>
#include <utility>

#include "core/clock.h"
#include "core/errors.h"
#include "scene/shines.h"

namespace knotlight {
namespace {

// Fills in the looks of a view that has `solved`.
void finish(SolvedView& view, PreparedScene prepared, RunContext& run) {
  auto scene = std::make_shared<PreparedScene>(std::move(prepared));
  const auto shade = [&](Look& look, GlowingSurfaces surfaces) {
    look.surfaces = std::move(surfaces);
    look.shading = std::make_unique<const Shading>(scene->scene, *scene->caster, look.surfaces);
  };
  GlowingSurfaces surfaces = glowing_surfaces(*scene, *view.solved, run);
  if (chosen_exitance(scene->scene.solver) == Exitance::gather) {
    // The same seen from the surface alone.
    GlowingSurfaces quick = surfaces;
    for (auto& surface : quick)
      if (surface) surface->inside.channels.clear();
    shade(view.quick_look.emplace(), std::move(quick));
  }
  shade(view.look, std::move(surfaces));
  view.prepared = std::move(scene);
}

}  // namespace

SolverSettings preview_of(const SolverSettings& settings, const PreviewSettings& preview) {
  SolverSettings chosen = settings;
  chosen.photons = std::min(settings.photons, preview.photons);
  chosen.photons_at_most = false;
  chosen.tolerance = std::max(settings.tolerance, preview.tolerance);
  return chosen;
}

std::shared_ptr<const SolvedView> solve_view(Scene scene, Quality quality, RunContext& run,
                                             FactorCache& factors) {
  const auto start = Clock::now();
  if (!anything_shines(scene))
    throw InputError("nothing shines, expected a light or an emission above 0");
  auto view = std::make_shared<SolvedView>();
  view->quality = quality;
  choose_for_picture(scene.solver);
  PreparedScene prepared = prepare_scene(std::move(scene));
  view->solved = std::make_shared<const SolvedScene>(solve_scene(prepared, run, factors));
  finish(*view, std::move(prepared), run);
  view->solved_scene = view->prepared;
  view->seconds = seconds_since(start);
  return view;
}

std::shared_ptr<const SolvedView> with_exitance(const SolvedView& view, const Scene& scene,
                                                RunContext& run) {
  const auto start = Clock::now();
  auto changed = std::make_shared<SolvedView>();
  changed->quality = view.quality;
  changed->solved_scene = view.solved_scene;
  changed->solved = view.solved;
  Scene looked_at = view.prepared->scene;
  looked_at.solver.exitance = scene.solver.exitance;
  finish(*changed, prepare_scene(std::move(looked_at)), run);
  changed->seconds = view.seconds + seconds_since(start);
  return changed;
}

}  // namespace knotlight
