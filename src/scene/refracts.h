// Whether light is bent anywhere in a scene.
#pragma once

#include <algorithm>

#include "scene/scene.h"

namespace knotlight {

// Whether a translucent object has another index than what surrounds it.
inline bool anything_refracts(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [](const Object& object) {
    return object.translucent() != nullptr && object.translucent()->ior != 1.0;
  });
}

}  // namespace knotlight
