// What every picture file says about itself.
#pragma once

#include <string>
#include <vector>

#include "core/image_io.h"
#include "pipeline/run_options.h"
#include "scene/scene.h"

namespace knotlight {

// Program, scene, unit, seed, overrides, and whether it can be trusted: `failures` are the checks
// that it did not pass, one sentence each.
Metadata picture_metadata(const Scene& scene, const std::string& path,
                          const std::vector<std::string>& failures, const RunContext& run);

}  // namespace knotlight
