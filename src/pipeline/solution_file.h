// A solved scene on disc, so that other pictures of it cost only ray tracing
// (docs/solution-file.md).
#pragma once

#include <string>

#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "render/shading.h"

namespace knotlight {

// Writes what pictures need of the solution: `surfaces` are those made of it, the report is that of
// the solve. Whole or not at all.
void write_solution(const std::string& path, const PreparedScene& prepared,
                    const SolvedScene& solved, const GlowingSurfaces& surfaces,
                    const RunContext& run);

// Reads it back: glowing_surfaces of the result are the same bits. U_d is known at the nodes of the
// surface grids and, with the grid method, everywhere; elsewhere it is not-a-number. Throws
// InputError, one line, if the file is none of ours, of another version, damaged, of a scene that
// differs in anything a solution depends on (says in what), or if it lacks what the exitance of the
// scene needs.
SolvedScene read_solution(const std::string& path, const PreparedScene& prepared, RunContext& run);

}  // namespace knotlight
