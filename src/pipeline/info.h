// The `info` command: what a scene is and what would be solved, without solving it.
#pragma once

#include <string>

#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "scene/scene.h"

namespace knotlight {

// Validity of every translucent object and, if `audit`, where the power that arrives at it goes, by
// photons of all orders.
Report inspect_scene(const std::string& path, bool audit, RunContext& run, Scene& scene_out);

// The report as text for a person.
std::string describe(const Report& report, const Scene& scene);

}  // namespace knotlight
