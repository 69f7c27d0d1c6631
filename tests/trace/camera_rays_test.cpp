#include "trace/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knotlight {
namespace {

Camera looking_along_y() {
  Camera camera;
  camera.from = Vec3(0, -5, 0);
  camera.to = Vec3::Zero();
  camera.up = Vec3::UnitZ();
  camera.fov = 90.0;
  camera.width_px = 200;
  camera.height_px = 100;
  return camera;
}

// The vertical field of view is between the top and bottom edge; right is +x when looking along +y
// with z up; row 0 is at the top.
TEST(CameraRays, PerspectiveFieldOfViewAndOrientation) {
  const CameraRays rays(looking_along_y());
  EXPECT_NEAR((rays.ray(100, 50).direction - Vec3::UnitY()).norm(), 0.0, 1e-15);
  const Vec3 top = rays.ray(100, 0).direction;
  EXPECT_NEAR(std::atan2(top.z(), top.y()), std::atan(1.0), 1e-14);  // 45 degrees up
  const Vec3 right = rays.ray(200, 50).direction;
  EXPECT_NEAR(right.x() / right.y(), 2.0, 1e-14);  // aspect 2
  EXPECT_EQ(rays.ray(3, 7).origin, Vec3(0, -5, 0));
}

TEST(CameraRays, OrthographicRaysAreParallelAndSpanTheWidth) {
  Camera camera = looking_along_y();
  camera.type = Camera::Type::orthographic;
  camera.width = 4.0;
  const CameraRays rays(camera);
  EXPECT_NEAR((rays.ray(0, 0).origin - Vec3(-2, -5, 1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((rays.ray(200, 100).origin - Vec3(2, -5, -1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((rays.ray(17, 80).direction - Vec3::UnitY()).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace knotlight
