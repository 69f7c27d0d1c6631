// The `render` command: scene file -> picture.
#pragma once

#include <string>
#include <vector>

#include "core/image_io.h"
#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "pipeline/solve_scene.h"
#include "render/shading.h"
#include "scene/scene.h"

namespace knotlight {

// The field at the nodes of every object's surface grid, each node evaluated once. What could not
// be solved stays dark.
GlowingSurfaces glowing_surfaces(const PreparedScene& prepared, const SolvedScene& solved,
                                 RunContext& run);

// The scene as its camera sees it, linear radiance. What could not be solved stays dark.
Image take_picture(const PreparedScene& prepared, const SolvedScene& solved, RunContext& run);

// Solves every translucent object and writes the picture to each of `outputs` (.exr or .png). The
// picture is written also if a check fails; its metadata then says so.
Report render_scene(const std::string& path, const std::vector<std::string>& outputs,
                    RunContext& run, Scene& scene_out);

}  // namespace knotlight
