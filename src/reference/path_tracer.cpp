#include "reference/path_tracer.h"

#include "reference/path_walk.h"

namespace knotlight {

PathTracer::PathTracer(const Scene& scene, const RayCaster& caster) {
  if (scene.channels == 1)
    walker_ = std::make_unique<PathWalker<1>>(scene, caster);
  else
    walker_ = std::make_unique<PathWalker<3>>(scene, caster);
}

PathTracer::~PathTracer() = default;

Spectrum PathTracer::radiance(const Ray& eye, Rng& rng) const {
  return walker_->radiance(eye, rng);
}

}  // namespace knotlight
