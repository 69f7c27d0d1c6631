// From solved fields to what pictures look up: the bridge between the solvers and src/render.
#pragma once

#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "render/shading.h"

namespace knotlight {

// How light is to leave the surface: gather if the scene does not say.
Exitance chosen_exitance(const SolverSettings& settings);

// Sets what the scene leaves open and pictures want otherwise than fields: the equation beyond P1
// whose solution `gather` can complete.
void choose_for_picture(SolverSettings& settings);

// Every field where the picture needs it, each place evaluated once: at the nodes of the surface
// grid, and, for gather, at those of a grid of cells in the object, which is the grid method's own
// or one of the cells it would take. What could not be solved stays dark.
GlowingSurfaces glowing_surfaces(const PreparedScene& prepared, const SolvedScene& solved,
                                 RunContext& run);

}  // namespace knotlight
