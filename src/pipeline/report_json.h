// The summary that --json writes.
#pragma once

#include <string>

#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "scene/scene.h"

namespace knotlight {

// Keys and units: docs/json.md. Quantities per channel are a number for a scene of one channel and
// a list for three. Numbers that are not finite are written as null.
std::string report_json(const std::string& command, const Report& report, const Scene& scene,
                        const RunContext& run);

}  // namespace knotlight
