// One straight piece of a photon's path inside a translucent object: what counts along paths.
#pragma once

#include <cstdint>

#include "core/vec3.h"

namespace knotlight {

struct FreeFlight {
  Vec3 start;
  Vec3 direction;  // unit
  double length;
  double power;          // W
  std::uint32_t object;  // it runs in
  std::uint32_t order;   // interactions so far since the photon entered the object
  bool interacts;        // at its end; else it ends at a surface
};

}  // namespace knotlight
