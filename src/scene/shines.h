// Whether there is anything to see by.
#pragma once

#include "scene/scene.h"

namespace knotlight {

// A light that sends anything, or an object that emits light itself.
bool anything_shines(const Scene& scene);

}  // namespace knotlight
