// Unbiased Monte Carlo estimate of the radiance that reaches the eye: volume path tracing of the
// radiative transfer equation [I78], with no diffusion, no photon map and no limit on the number of
// bounces. Method and cost: docs/reference.md.
#pragma once

#include <memory>

#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

class PathTracer {
 public:
  // `scene` and `caster` must outlive this; caster was built from scene.objects in order.
  PathTracer(const Scene& scene, const RayCaster& caster);
  ~PathTracer();
  PathTracer(const PathTracer&) = delete;
  PathTracer& operator=(const PathTracer&) = delete;

  // One estimate of the radiance, W/(length^2 sr), that comes against the direction of a ray which
  // starts outside all translucent objects. Its expectation is exact but for the paths that
  // docs/reference.md lists under "What it cannot find".
  Spectrum radiance(const Ray& eye, Rng& rng) const;

  class Walker;

 private:
  std::unique_ptr<const Walker> walker_;
};

}  // namespace knotlight
