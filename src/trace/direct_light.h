// Light that reaches a point of the surroundings straight from the lights.
#pragma once

#include <optional>

#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// The surface of an opaque object that the line through p along d crosses within the touching
// distance of p: what an object stands on, for example, which a search from p would skip.
std::optional<Hit> opaque_contact(const Scene& scene, const RayCaster& caster, const Vec3& p,
                                  const Vec3& d);

// Fraction (0..1, per channel) of light that travels unscattered from a towards b. Diffuse and
// refracting objects block it; index-matched translucent ones let exp(-sigma_t * length) through.
Spectrum transmittance(const Scene& scene, const RayCaster& caster, const Vec3& a,
                       const Vec3& direction, double distance);

// One Monte Carlo estimate of the irradiance (W/length^2) on the side of a surface that the unit
// normal points to; one sample per light, exact for point and directional lights. Unbiased. With
// the relative index `ior` of a smooth dielectric surface: of the part that enters it.
Spectrum sample_irradiance(const Scene& scene, const RayCaster& caster, const Vec3& position,
                           const Vec3& normal, Rng& rng, double ior = 1.0);

// Mean of `samples` such estimates, of one if that is exact, since all lights are points or
// directions; and, where the scene has reflecting diffuse objects, of as many estimates of the
// irradiance by those in sight (trace/surroundings.h), which is added.
Spectrum mean_irradiance(const Scene& scene, const RayCaster& caster, const Vec3& position,
                         const Vec3& normal, int samples, Rng& rng, double ior);

// The radiance of the nearest area light that the ray meets before t_max (zero from behind), or
// nothing if it meets none.
std::optional<Spectrum> area_light_seen(const Scene& scene, const Ray& ray);

// Whether one sample of the lights' irradiance is as good as many: all are points or directions.
bool irradiance_is_exact(const Scene& scene);

// The part of the radiance from infinity that is the same from everywhere.
Spectrum constant_environment(const Scene& scene);

// Radiance from infinity along a ray that meets nothing.
Spectrum environment_radiance(const Scene& scene, const Vec3& direction);

}  // namespace knotlight
