// Irradiance on the surface of an object: what the source models without volume photons start from.
#pragma once

#include <vector>

#include "core/parallel.h"
#include "core/shape.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct IrradianceSample {
  SurfacePoint surface;
  double area;     // of the surface that the sample stands for, length^2
  double entered;  // (1 - R_F) E: light from the lights that passes into the object, W/length^2
};

// Mean of `rays` estimates of the light that enters the object at one point of its surface,
// W/length^2; exact with one ray if all lights are points or directions. Light that the object, or
// another one, scattered back is not in it, nor is that of a light inside the object.
double entering_irradiance(const Scene& scene, const RayCaster& caster, int channel,
                           std::uint32_t object, const SurfacePoint& at, int rays, Rng& rng);

// The same at N points, W/length^2 each; point i draws from stream i of the seed. Same bits for any
// number of workers.
Eigen::VectorXd entering_irradiances(const Scene& scene, const RayCaster& caster, int channel,
                                     std::uint32_t object, const SurfaceSamples& at, int rays,
                                     std::uint64_t seed, const Workers& workers);

// `count` samples, one in each stratum of equal area, each from `rays` rays. `replicate` gives
// independent sets under one seed. Same bits for any number of workers.
std::vector<IrradianceSample> sample_irradiances(const Scene& scene, const RayCaster& caster,
                                                 int channel, std::uint32_t object,
                                                 std::size_t count, int rays, std::uint64_t seed,
                                                 std::uint64_t replicate, const Workers& workers);

}  // namespace knotlight
