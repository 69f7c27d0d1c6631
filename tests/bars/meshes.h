// The surfaces of the bars, exactly those that the reference fields were made for.
#pragma once

#include <string>

#include "core/ply_writer.h"

namespace knotlight {

// Torus around the z axis, R = 1, r = 0.35, 160 x 56 cells of two triangles.
TriangleMesh torus_mesh();

// A ball of radius 1 with bumps 0.1 high, 972 triangles: coarse, so that its facets are the
// surface, and what is refined from it is the same surface.
TriangleMesh bumpy_mesh();

// A ball whose ripples are so fine that `triangles` resolve them with 12 edges each; their height
// is a tenth of their length.
TriangleMesh rippled_mesh(std::size_t triangles);

// The same surface in at least `triangles` triangles, by halving longest edges.
TriangleMesh refined_to(TriangleMesh mesh, std::size_t triangles);

// Debian's bunny without its two pairs of crossing triangles: five vertices are moved, by 0.008 at
// most, to where tetgen finds no crossing. Throws std::runtime_error if the file is not there.
TriangleMesh mended_bunny(const std::string& obj);

}  // namespace knotlight
