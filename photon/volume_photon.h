// What the tracer leaves behind and the map stores.
#pragma once

#include <cstdint>
#include <limits>

#include "core/vec3.h"

namespace knotlight {

// A photon at the moment it interacts (is scattered or absorbed) inside a translucent object.
struct VolumePhoton {
  Vec3 position;
  Vec3 direction;             // of travel before the interaction, unit
  double power;               // dPhi, W
  std::uint32_t order;        // 1 = first interaction since it entered the object
  std::uint32_t surface = 0;  // triangle of the object's mesh that `depth` is below
  // Below the planes that touch the surface where its flight began and where it would have ended,
  // whichever is nearer; infinite if its flight touches no surface.
  double depth = std::numeric_limits<double>::infinity();
};

}  // namespace knotlight
