// The diffuse objects of a scene as a source of light: what they reflect of the lights' light and
// of each other's.
#pragma once

#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Reflected part (0..1) of the irradiance where a diffuse object was hit: the reflectance of its
// material times the interpolated colour of its vertices, if it has colours. Zero for a translucent
// object. The same on both sides.
Spectrum reflectance_at(const Object& object, const Hit& hit);

// Whether any diffuse object of the scene can reflect anything.
bool surroundings_reflect(const Scene& scene);

// One unbiased estimate of the radiance (W/(length^2 sr)) that the diffuse surface at `hit` sends
// against `direction`, the unit direction of the ray that met it: light that the lights threw on
// it, straight or by any number of other diffuse surfaces. On its way it passes index-matched
// translucent objects, weakened by exp(-sigma_t length). Not in it: light that was scattered,
// refracted or mirrored by a translucent object, or reflected by a diffuse object inside one.
Spectrum reflected_radiance(const Scene& scene, const RayCaster& caster, const Hit& hit,
                            const Vec3& direction, Rng& rng);

// One unbiased estimate of the irradiance (W/length^2) by reflected_radiance on the side of a
// surface that the unit normal points to, from all diffuse surfaces in sight, through index-matched
// objects too. With the relative index `ior` of a smooth dielectric surface: of the part that
// enters it.
Spectrum sample_surroundings_irradiance(const Scene& scene, const RayCaster& caster,
                                        const Vec3& position, const Vec3& normal, Rng& rng,
                                        double ior = 1.0);

}  // namespace knotlight
