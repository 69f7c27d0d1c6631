// What the tracer leaves behind and the map stores.
#pragma once

#include <cstdint>

#include "core/vec3.h"

namespace knotlight {

// A photon at the moment it interacts (is scattered or absorbed) inside a translucent object.
struct VolumePhoton {
  Vec3 position;
  Vec3 direction;       // of travel before the interaction, unit
  double power;         // dPhi, W
  std::uint32_t order;  // 1 = first interaction since it entered the object
};

}  // namespace knotlight
