// Light that leaves an object after a single scattering: the other half of the dipole's picture
// [JMLH01].
#pragma once

#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// One Monte Carlo estimate of the radiance (W/(length^2 sr), outside) that leaves the object at
// `hit` towards the origin of `ray`, having been scattered once, at one place of the refracted view
// ray:
//
//   L = T / ior^2 int exp(-sigma_t s) sigma_s p(w', w) T' (mu' / mu'_in) E exp(-sigma_t s') ds
//
// Light that is refracted is followed as [JMLH01] does: on a straight line from its place x of
// scattering to the light, of length s'_0 inside, with the cosine mu' outside where that line
// leaves, and s' = s'_0 mu' / mu'_in, mu'_in the refracted cosine. That is exact for a half-space
// under parallel light, and for any shape if ior = 1. Light mirrored on the inside is left out.
// `normal`: the surface's for shading. depth_sample in [0, 1) chooses the place: spread it evenly
// over the rays of one pixel.
Spectrum once_scattered(const Scene& scene, const RayCaster& caster, const Ray& ray, const Hit& hit,
                        const Vec3& normal, double depth_sample, Rng& rng);

}  // namespace knotlight
