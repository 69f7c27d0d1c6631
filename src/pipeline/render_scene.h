// The `render` command: scene file -> picture.
#pragma once

#include <string>
#include <vector>

#include "core/image_io.h"
#include "pipeline/glow.h"
#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "pipeline/solve_scene.h"
#include "scene/scene.h"

namespace knotlight {

// The scene as its camera sees it, linear radiance. What could not be solved stays dark.
Image take_picture(const PreparedScene& prepared, const SolvedScene& solved, RunContext& run);

// What `render` is asked for beside the scene.
struct RenderFiles {
  std::vector<std::string> pictures;  // .exr or .png
  std::vector<std::string> layers;    // names (chosen_layers), for the .exr among the pictures
  std::string solution = {};          // to read in place of solving; empty: solve
  std::string save_solution = {};     // to write the solution to; empty: nowhere
};

// Solves every translucent object, or reads their solution, and writes the pictures, also if a
// check fails; their metadata then says so.
Report render_scene(const std::string& path, const RenderFiles& files, RunContext& run,
                    Scene& scene_out);

}  // namespace knotlight
