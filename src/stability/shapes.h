// Awkward solids: closed meshes oriented outward.
#pragma once

#include "core/mesh.h"

namespace knotlight {

// Half axes (length) along x, y, z; `detail`: longest edge over the half axis.
TriangleMesh ellipsoid_mesh(const Vec3& center, const Vec3& half_axes, double detail);
// Regular tetrahedron with its tip at `tip` and the opposite face facing along the unit vector
// `base`, of the given height (length).
TriangleMesh tetrahedron_mesh(const Vec3& tip, const Vec3& base, double height);
// Kepler's star of two tetrahedra, eight spikes that end in the corners of a cube of side 2.
TriangleMesh star_mesh();
// Both in one mesh.
TriangleMesh both(TriangleMesh a, const TriangleMesh& b);

}  // namespace knotlight
