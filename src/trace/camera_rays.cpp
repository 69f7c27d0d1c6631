#include "trace/camera_rays.h"

#include <cmath>

#include "core/units.h"

namespace knotlight {

CameraRays::CameraRays(const Camera& camera)
    : camera_(camera),
      forward_((camera.to - camera.from).normalized()),
      right_(forward_.cross(camera.up).normalized()),
      up_(right_.cross(forward_)) {
  const double aspect = static_cast<double>(camera.width_px) / camera.height_px;
  if (camera.type == Camera::Type::perspective) {
    half_height_ = std::tan(0.5 * radians(camera.fov));
    half_width_ = half_height_ * aspect;
  } else {
    half_width_ = 0.5 * camera.width;
    half_height_ = half_width_ / aspect;
  }
}

Ray CameraRays::ray(double x, double y) const {
  const double right = (2.0 * x / camera_.width_px - 1.0) * half_width_;
  const double up = (1.0 - 2.0 * y / camera_.height_px) * half_height_;
  const Vec3 offset = right * right_ + up * up_;
  if (camera_.type == Camera::Type::perspective)
    return {camera_.from, (forward_ + offset).normalized()};
  return {camera_.from + offset, forward_};
}

}  // namespace knotlight
