#include "view/solved_view.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/errors.h"

namespace knotlight {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const Spectrum& power(const Light& light) {
  return std::visit(
      [](const auto& l) -> const Spectrum& {
        using L = std::decay_t<decltype(l)>;
        if constexpr (std::is_same_v<L, PointLight>) {
          return l.intensity;
        } else if constexpr (std::is_same_v<L, DirectionalLight>) {
          return l.irradiance;
        } else {
          return l.radiance;
        }
      },
      light);
}

void refuse_darkness(const Scene& scene) {
  const bool lit = std::any_of(scene.lights.begin(), scene.lights.end(),
                               [](const Light& light) { return (power(light) > 0.0).any(); });
  const bool glows =
      std::any_of(scene.objects.begin(), scene.objects.end(), [](const Object& object) {
        return object.translucent() != nullptr && (object.translucent()->emission > 0.0).any();
      });
  if (!lit && !glows) throw InputError("nothing shines, expected a light or an emission above 0");
}

// Light is gathered inside objects where the solution is known there.
bool gathers(const Scene& scene, const Plan& plan) {
  const std::optional<Exitance> exitance = scene.solver.exitance;
  return (!exitance || *exitance == Exitance::gather) &&
         std::any_of(plan.methods.begin(), plan.methods.end(),
                     [](const MethodChoice& choice) { return choice.method == Method::grid; });
}

// Fills in the looks of a view that has `solved`.
void finish(SolvedView& view, PreparedScene prepared, RunContext& run) {
  auto scene = std::make_shared<PreparedScene>(std::move(prepared));
  const auto shade = [&](Look& look) {
    look.surfaces = glowing_surfaces(*scene, *view.solved, run);
    look.shading = std::make_unique<const Shading>(scene->scene, *scene->caster, look.surfaces);
  };
  if (gathers(scene->scene, view.solved->plan)) {
    const std::optional<Exitance> wanted = scene->scene.solver.exitance;
    scene->scene.solver.exitance = Exitance::p1;
    shade(view.quick_look.emplace());
    scene->scene.solver.exitance = wanted;
  }
  shade(view.look);
  view.prepared = std::move(scene);
}

}  // namespace

SolverSettings preview_of(const SolverSettings& settings, const PreviewSettings& preview) {
  SolverSettings chosen = settings;
  chosen.photons = std::min(settings.photons, preview.photons);
  chosen.tolerance = std::max(settings.tolerance, preview.tolerance);
  return chosen;
}

std::shared_ptr<const SolvedView> solve_view(Scene scene, Quality quality, RunContext& run,
                                             FactorCache& factors) {
  const auto start = Clock::now();
  refuse_darkness(scene);
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
