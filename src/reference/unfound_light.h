// How much light a path from the eye cannot find. Point lights and beams have no size that a path
// could run into; they are found along straight ways and along those refracted once into the medium
// of the vertex. What takes another way before it is first scattered is left out of the picture, so
// its share has to be known.
#pragma once

#include <cstdint>

#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Of the light of point lights and beams that is ever scattered, in a medium or on a diffuse
// surface: the share (0..1) that was mirrored, refracted out of an object, or refracted twice
// before it was scattered first. By following light from the lamps; channels count alike. 0 without
// such lights. `caster` was built from scene.objects in order.
double unfound_share(const Scene& scene, const RayCaster& caster, std::uint64_t seed);

// Throws InputError if point lights or beams meet a rough refracting surface, through which no
// sampled way leads to them.
void refuse_unfindable_lights(const Scene& scene);

}  // namespace knotlight
