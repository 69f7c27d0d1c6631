// The light of the lights that has not been scattered yet, just below a point of a translucent
// object's surface, looked for from there: what photons estimate, without photons.
#pragma once

#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct UnscatteredLight {
  Spectrum U_ri = Spectrum::Zero();  // mean intensity, W/(length^2 sr)
  Spectrum F_ri = Spectrum::Zero();  // net flux out of the object, F_ri . n, W/length^2
};

// Mean of estimates at `hit`, a point of a translucent object: exact where all lights are points or
// directions and nothing reflects, otherwise Monte Carlo with `samples` samples of each light.
//
// Index-matched: all light, also what has crossed this and other index-matched objects, weakened by
// exp(-sigma_t length), and what diffuse objects reflect. ior > 1: what enters at the point itself,
// as through a smooth surface; what has crossed the object inside is not found.
UnscatteredLight unscattered_light(const Scene& scene, const RayCaster& caster, const Hit& hit,
                                   int samples, Rng& rng);

}  // namespace knotlight
