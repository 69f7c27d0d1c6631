// Two solids cannot fill the same space.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Throws InputError naming both objects if two translucent objects of the scene overlap by more
// than 1e-6 of the smaller one's size. Touching is allowed. `caster` was built from scene.objects
// in order.
void refuse_overlaps(const Scene& scene, const RayCaster& caster);

// Names of the diffuse objects that reach into a translucent one: "object 'a' reaches into 'b'",
// one sentence each. Light inside meets them, the diffusion equation does not know them.
std::vector<std::string> opaque_inclusions(const Scene& scene, const RayCaster& caster);

}  // namespace knotlight
