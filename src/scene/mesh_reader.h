// Meshes from files, and the checks that make a mesh a solid.
#pragma once

#include <string>
#include <vector>

#include "core/mesh.h"

namespace knotlight {

// Reads PLY, OBJ or STL (assimp; whatever else it knows works too), all parts of the file as one
// mesh, polygons triangulated, vertices at the same position and of the same colour merged. Vertex
// colours, where the file has them, are taken as sRGB if they are integers and as linear if they
// are floating-point numbers; parts without are white. Throws InputError (without a
// file:line prefix) if the file is missing, unreadable, empty or has coordinates that are not
// finite or
// colours that are not numbers from 0 to 1.
TriangleMesh read_mesh(const std::string& path);

// Merges vertices of the same colour closer than `tolerance` (length) and drops triangles that
// become degenerate and vertices that nothing uses. Returns how many vertices were merged.
std::size_t merge_vertices(TriangleMesh& mesh, double tolerance);

// Turns the mesh into a solid or throws InputError (without a file:line prefix) that says what is
// wrong and where:
// - degenerate triangles are dropped (warning if that opens nothing),
// - inconsistent or inward orientation is turned (warning),
// - small simple holes (a single loop of at most 32 edges, not larger than 5 % of the mesh's size)
//   are closed (warning),
// - larger holes, edges with more than two triangles, vertices that are not finite: refused,
// - triangles that intersect others: warned about up to 1 % of all, refused beyond,
// - vertex colours are left out (warning).
// Warnings are appended, one line each.
TriangleMesh make_solid(TriangleMesh mesh, std::vector<std::string>& warnings);

// Pairs of triangles that cross each other (sharing no vertex), at most `limit`.
std::vector<std::pair<std::size_t, std::size_t>> intersecting_triangles(const TriangleMesh& mesh,
                                                                        std::size_t limit);

}  // namespace knotlight
