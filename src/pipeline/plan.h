// What will be solved for a scene, and why: the source model and the method that settings left out,
// or `auto`, stand for.
#pragma once

#include <string>

#include "pipeline/scene_setup.h"

namespace knotlight {

struct MethodChoice {
  Method method = Method::grid;  // automatic: bkm, and lbkm where that leaves too much
  std::string reason;            // a sentence for people, starting with the method's name
};

struct Plan {
  SourceModel source = SourceModel::photon_map;
  std::string source_reason;          // a sentence for people, starting with the model's name
  std::vector<MethodChoice> methods;  // one per translucent object, PreparedScene::translucent
};

// Throws InputError for a source model that the method asked for cannot take.
Plan make_plan(const PreparedScene& prepared);

const char* name_of(SourceModel model);
const char* name_of(Method method);
const char* name_of(Exitance exitance);

}  // namespace knotlight
