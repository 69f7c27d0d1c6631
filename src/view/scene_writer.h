// Writing a changed scene as YAML that every command takes: the tree that was read, with the keys
// that were changed in the viewer replaced. Keys that the viewer does not know stay as they are.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"
#include "scene/yaml_reader.h"

namespace knotlight {

// Puts into `document`, the tree of the scene `before`, what differs in `after` of: the camera, the
// lights, the coefficients of materials, and the solver's tolerance, source, method, boundary,
// exitance and photons. The two scenes have the same lights and objects in the same order.
void put_changes(YamlNode& document, const Scene& before, const Scene& after);

// Makes the files that the document names relative to `from` relative to `to` (folders).
void move_paths(YamlNode& document, const std::filesystem::path& from,
                const std::filesystem::path& to);

// The tree as YAML text: sections in blocks, what is below their entries in one line each.
std::string yaml_text(const YamlNode& document);

// The lines at the beginning of the file that are comments.
std::string leading_comment(const std::string& file);

}  // namespace knotlight
