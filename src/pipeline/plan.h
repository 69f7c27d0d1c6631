// What will be solved for a scene, and why: the source model and the method that settings left out,
// or `auto`, stand for.
#pragma once

#include <string>

#include "pipeline/scene_setup.h"

namespace knotlight {

struct Plan {
  SourceModel source = SourceModel::photon_map;
  Method method = Method::grid;
  std::string source_reason;  // a sentence for people, starting with the model's name
  std::string method_reason;
};

// Throws InputError for a source model that the method asked for cannot take.
Plan make_plan(const PreparedScene& prepared);

const char* name_of(SourceModel model);

}  // namespace knotlight
