// Whether light that has left an object can meet it again.
#pragma once

#include "core/shape.h"

namespace knotlight {

// True if the shape is one convex body: a sphere, or a closed mesh in one piece that bends inwards
// at no edge (up to rounding of its vertices, 1e-6 of an edge's length). O(n log n).
bool is_convex(const Shape& shape);

}  // namespace knotlight
