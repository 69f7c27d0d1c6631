#include "view/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// From the axis: nearer, the picture would spin about its middle.
constexpr double least_angle_to_axis = 0.02;

struct Axes {
  Vec3 forward, right, up;
};

Axes axes(const Camera& camera) {
  const Vec3 forward = (camera.to - camera.from).normalized();
  const Vec3 right = forward.cross(camera.up).normalized();
  return {forward, right, right.cross(forward)};
}

}  // namespace

Camera orbited(const Camera& camera, double right, double down) {
  const Vec3 axis = camera.up.normalized();
  const Vec3 arm = camera.from - camera.to;
  const Vec3 around = Eigen::AngleAxisd(-right * pi, axis) * arm;
  const double angle = std::acos(std::clamp(around.normalized().dot(axis), -1.0, 1.0));
  const double wanted =
      std::clamp(angle - down * pi, least_angle_to_axis, pi - least_angle_to_axis);
  const Vec3 hinge = axis.cross(around).normalized();  // turning about it leads away from the axis
  Camera moved = camera;
  moved.from = camera.to + Eigen::AngleAxisd(wanted - angle, hinge) * around;
  return moved;
}

Camera zoomed(const Camera& camera, double factor) {
  Camera moved = camera;
  if (camera.type == Camera::Type::orthographic)
    moved.width = camera.width * factor;
  else
    moved.from = camera.to + factor * (camera.from - camera.to);
  return moved;
}

Camera panned(const Camera& camera, double right, double down) {
  const Vec3 shift = shift_in_picture(camera, camera.to, right, down);
  Camera moved = camera;
  moved.from -= shift;
  moved.to -= shift;
  return moved;
}

double picture_height_at(const Camera& camera, const Vec3& point) {
  if (camera.type == Camera::Type::orthographic)
    return camera.width * camera.height_px / camera.width_px;
  const double distance = axes(camera).forward.dot(point - camera.from);
  return 2.0 * std::tan(0.5 * radians(camera.fov)) * distance;
}

Vec3 shift_in_picture(const Camera& camera, const Vec3& point, double right, double down) {
  const Axes a = axes(camera);
  return picture_height_at(camera, point) * (right * a.right - down * a.up);
}

std::optional<Eigen::Vector2d> projected(const Camera& camera, const Vec3& point) {
  const Axes a = axes(camera);
  const Vec3 offset = point - camera.from;
  if (camera.type == Camera::Type::perspective && a.forward.dot(offset) <= 0.0) return std::nullopt;
  const double pixels = camera.height_px / picture_height_at(camera, point);
  return Eigen::Vector2d(0.5 * camera.width_px + pixels * a.right.dot(offset),
                         0.5 * camera.height_px - pixels * a.up.dot(offset));
}

}  // namespace knotlight
