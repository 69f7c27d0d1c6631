// "path.to.key=value" from the command line, put into the tree before it is read, so that an
// override passes exactly the checks that the file passes.
#pragma once

#include <string>

#include "scene/yaml_reader.h"

namespace knotlight {

// Steps of the path: keys of maps; in lists the number of an item (from 0) or its `name`. Missing
// keys of maps are created (whether they mean anything is found out by the reader); the value null
// takes the key out. Throws InputError "--set path: ..." for a path that leads nowhere and for a
// value that is not YAML.
void apply_override(YamlNode& root, const std::string& override_text);

}  // namespace knotlight
