// A mesh as a file.
#pragma once

#include <string>

#include "core/mesh.h"

namespace knotlight {

// Binary little-endian PLY, coordinates in float; like the rest of the program, for little-endian
// machines; whole or not at all. comment: a line for the header, none if empty. Throws
// std::runtime_error if the file cannot be written.
void write_ply(const std::string& path, const TriangleMesh& mesh, const std::string& comment = "");

}  // namespace knotlight
