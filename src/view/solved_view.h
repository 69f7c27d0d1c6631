// A scene solved and ready to be looked at: everything the picture needs in one piece, which the
// threads of the viewer share and never change.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/render_scene.h"
#include "pipeline/solve_scene.h"
#include "render/shading.h"

namespace knotlight {

enum class Quality {
  preview,  // few photons and a coarse tolerance: to follow the hand
  full,     // as the scene has it
};

// What was changed since the scene was solved last.
enum class Change {
  exitance,   // the field stays as it is
  lights,     // factored systems stay
  materials,  // of objects, or settings of the solver: everything is solved anew
};

// Leaves some 3 % of noise in the shipped scenes, which the eye overlooks while things move, and
// takes a quarter of a second (tests/bench/view_bench.cpp).
struct PreviewSettings {
  std::size_t photons = 40'000;  // per channel
  double tolerance = 0.05;
};

// The scene's settings for a preview: never more photons or a finer tolerance than the scene's.
SolverSettings preview_of(const SolverSettings& settings, const PreviewSettings& preview);

// Light leaving the surfaces with one exitance.
struct Look {
  GlowingSurfaces surfaces;
  std::unique_ptr<const Shading> shading;  // borrows from the surfaces and the scene
};

struct SolvedView {
  Quality quality = Quality::preview;
  double seconds = 0.0;  // from the scene to here
  // What the field was solved from and the solution; another exitance shares them.
  std::shared_ptr<const PreparedScene> solved_scene;
  std::shared_ptr<const SolvedScene> solved;
  // What is looked at, with the exitance asked for.
  std::shared_ptr<const PreparedScene> prepared;
  Look look;
  // For pictures in motion where `look` would gather light inside the objects, which is slow: the
  // field on the surface alone (exitance p1).
  std::optional<Look> quick_look;

  const Report& report() const { return solved->report; }
  const Look& look_in_motion() const { return quick_look ? *quick_look : look; }
};

// Solves the scene with its own settings; `quality` says what they stand for. Throws InputError for
// settings that do not go together and for a scene without light, Cancelled if the run's workers
// are.
std::shared_ptr<const SolvedView> solve_view(Scene scene, Quality quality, RunContext& run,
                                             FactorCache& factors);
// The same solution with the exitance of `scene`.
std::shared_ptr<const SolvedView> with_exitance(const SolvedView& view, const Scene& scene,
                                                RunContext& run);

}  // namespace knotlight
