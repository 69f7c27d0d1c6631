// Scene -> what every command starts from.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/run_options.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct PreparedScene {
  Scene scene;
  std::unique_ptr<RayCaster> caster;
  std::vector<std::uint32_t> translucent;  // indices of translucent objects
};

// Reads, checks, builds the ray caster, refuses overlapping solids and an eye inside one. Prints
// the scene's warnings to stderr unless quiet.
PreparedScene prepare_scene(const std::string& path, RunContext& run);

// The same for a scene made in memory, which has no file to name and perhaps no picture to take:
// refuses overlapping solids (InputError), leaves the camera unchecked, prints nothing.
PreparedScene prepare_scene(Scene scene);

}  // namespace knotlight
