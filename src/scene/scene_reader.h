// YAML -> Scene. The one file that knows yaml-cpp is yaml_reader.cpp.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace knotlight {

// Reads and checks the scene file; `overrides` are "path.to.key=value" as given to --set (list
// items by number: lights.0.intensity=3; objects also by name: objects.knot.scale=2). Everything
// wrong throws InputError "file:line: key: what is wrong, expected ..."; errors in an override are
// reported as "--set path.to.key: ...".
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace knotlight
