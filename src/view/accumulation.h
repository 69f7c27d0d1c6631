// A picture that gets better with every pass: the mean over any number of samples per pixel.
#pragma once

#include <functional>

#include "core/image_io.h"
#include "core/parallel.h"
#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// What is seen along a ray.
using RaySample = std::function<Spectrum(const Ray& ray, Rng& rng)>;

class Accumulation {
 public:
  Accumulation(const Camera& camera, std::uint64_t seed);

  // One more sample in every pixel; the first through its middle, the others spread evenly over it.
  // The same bits for any number of threads. If the workers are cancelled (Cancelled is thrown) the
  // accumulation is spoilt and must not be used again.
  void add_pass(const RaySample& sample, const Workers& workers);

  int passes() const { return passes_; }
  Image mean() const;

 private:
  Camera camera_;
  std::uint64_t seed_;
  int passes_ = 0;
  std::vector<Spectrum> sums_;
};

// The camera with as large a picture of the same shape as fits into width x height pixels.
Camera fitted(Camera camera, int width, int height);
// The camera with a picture of one pixel for every `stride` x `stride` of its own.
Camera coarse(Camera camera, int stride);

}  // namespace knotlight
