// The `probe` command: the solved field at given points.
#pragma once

#include <string>

#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "scene/scene.h"

namespace knotlight {

// Reads points (a header with at least x, y, z; rows of numbers) from `points_csv`, solves the
// scene and writes x, y, z, U_d.c, U_ri.c per channel (mean intensities, W/(length^2 sr)) and
// status to `output_csv`. Points within 1e-3 of an object's size of its surface count as on it; a
// point in no translucent object gets status "outside" and nan.
Report probe_scene(const std::string& path, const std::string& points_csv,
                   const std::string& output_csv, RunContext& run, Scene& scene_out);

}  // namespace knotlight
