// Rays from the eye.
#pragma once

#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

class CameraRays {
 public:
  explicit CameraRays(const Camera& camera);

  // The ray through (x, y) in pixels, (0, 0) = top left corner of the picture, unit direction.
  Ray ray(double x, double y) const;

 private:
  Camera camera_;
  Vec3 forward_, right_, up_;        // orthonormal
  double half_width_, half_height_;  // perspective: at distance 1; orthographic: in scene units
};

}  // namespace knotlight
