// Points at which a solution is checked: none of them is a knot.
#pragma once

#include <vector>

#include "core/shape.h"
#include "trace/ray_caster.h"

namespace knotlight {

// `count` points uniform in the object's volume (rejection from its bounding box); fewer, perhaps
// none, if the object fills next to nothing of its box.
Points volume_points(const Shape& shape, const RayCaster& caster, std::uint32_t object,
                     std::size_t count, std::uint64_t seed);

}  // namespace knotlight
