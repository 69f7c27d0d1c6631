// All translucent objects of a scene, solved in every channel.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/plan.h"
#include "pipeline/report.h"
#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_object.h"

namespace knotlight {

struct SolvedScene {
  // One entry per translucent object in scene order, in it one per channel.
  std::vector<std::vector<SolvedChannel>> objects;
  Plan plan;
  // [channel][translucent object], if it was to be kept: what the solution was made from.
  std::vector<std::vector<IncidentLight>> light;
  Report report;
};

// The scene of similar media that is solved in place of this one, if it is: what is known beyond P1
// is known for isotropic scattering.
std::optional<PreparedScene> similar_scene(const PreparedScene& prepared);

SolvedScene solve_scene(const PreparedScene& prepared, RunContext& run, bool keep_light = false);
// The same with systems factored by an earlier solve of the same objects and materials under other
// lights, and kept for the next: only photons and back-substitutions are left to do.
SolvedScene solve_scene(const PreparedScene& prepared, RunContext& run, FactorCache& factors,
                        bool keep_light = false);

}  // namespace knotlight
