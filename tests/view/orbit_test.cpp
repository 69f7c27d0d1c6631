#include "view/orbit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "trace/camera_rays.h"

namespace knotlight {
namespace {

constexpr double rounding = 1e-12;  // of a dozen operations on numbers near 1

Camera camera_from(const Vec3& from) {
  Camera camera;
  camera.from = from;
  camera.to = Vec3(0.5, -0.2, 0.3);
  camera.up = Vec3(0.2, 0.1, 1.0).normalized();
  camera.width_px = 64;
  camera.height_px = 48;
  return camera;
}

TEST(Orbit, KeepsDistanceTargetAndAxis) {
  const Camera camera = camera_from({1, -5, 2});
  const Camera moved = orbited(camera, 0.37, -0.12);
  EXPECT_EQ(moved.to, camera.to);
  EXPECT_EQ(moved.up, camera.up);
  EXPECT_NEAR((moved.from - moved.to).norm(), (camera.from - camera.to).norm(), 10 * rounding);
  EXPECT_GT((moved.from - camera.from).norm(), 1.0);
}

// A picture height is half a turn: two of them to the right lead back.
TEST(Orbit, TwoPictureHeightsAreAFullTurn) {
  const Camera camera = camera_from({1, -5, 2});
  EXPECT_LT((orbited(camera, 2.0, 0.0).from - camera.from).norm(), 100 * rounding);
  const Vec3 arm = camera.from - camera.to;
  const Vec3 turned = orbited(camera, 1.0, 0.0).from - camera.to;
  const Vec3 across = arm - arm.dot(camera.up) * camera.up;
  EXPECT_LT((turned - (arm - 2.0 * across)).norm(), 100 * rounding);
}

// What the mouse holds, on the side of the target that faces the eye, follows it.
TEST(Orbit, TheNearSideFollowsTheMouse) {
  const Camera camera = camera_from({1, -5, 2});
  const Vec3 near_point = camera.to + 0.1 * (camera.from - camera.to);
  const Eigen::Vector2d before = *projected(camera, near_point);
  EXPECT_GT(projected(orbited(camera, 0.05, 0.0), near_point)->x(), before.x());
  EXPECT_GT(projected(orbited(camera, 0.0, 0.05), near_point)->y(), before.y());
}

TEST(Orbit, StopsShortOfTheAxis) {
  for (const double down : {3.0, -3.0}) {
    const Camera moved = orbited(camera_from({1, -5, 2}), 0.0, down);
    const Vec3 view = (moved.to - moved.from).normalized();
    EXPECT_GT(view.cross(moved.up).norm(), 0.01);
    // Upwards the mouse pulls the near side up: the eye goes below.
    EXPECT_EQ((moved.from - moved.to).dot(moved.up) > 0.0, down > 0.0);
  }
}

TEST(Orbit, ZoomsByDistanceOrWidth) {
  Camera camera = camera_from({1, -5, 2});
  EXPECT_LT((zoomed(camera, 0.5).from - 0.5 * (camera.from + camera.to)).norm(), rounding);
  camera.type = Camera::Type::orthographic;
  camera.width = 3.0;
  EXPECT_EQ(zoomed(camera, 0.5).width, 1.5);
  EXPECT_EQ(zoomed(camera, 0.5).from, camera.from);
}

// A pan by some of the picture's height moves the target's image by just that.
TEST(Orbit, PanMovesThePictureWithTheMouse) {
  for (const auto type : {Camera::Type::perspective, Camera::Type::orthographic}) {
    Camera camera = camera_from({1, -5, 2});
    camera.type = type;
    camera.width = 4.0;
    const Eigen::Vector2d pixel = *projected(panned(camera, 0.25, -0.1), camera.to);
    EXPECT_NEAR(pixel.x(), 32.0 + 0.25 * 48.0, 1e-9);
    EXPECT_NEAR(pixel.y(), 24.0 - 0.1 * 48.0, 1e-9);
  }
}

// Against the rays that make the picture.
TEST(Orbit, ProjectionInvertsCameraRays) {
  for (const auto type : {Camera::Type::perspective, Camera::Type::orthographic}) {
    Camera camera = camera_from({1, -5, 2});
    camera.type = type;
    camera.width = 4.0;
    const Ray ray = CameraRays(camera).ray(13.25, 40.5);
    const auto pixel = projected(camera, ray.origin + 7.0 * ray.direction);
    ASSERT_TRUE(pixel.has_value());
    EXPECT_NEAR(pixel->x(), 13.25, 1e-9);
    EXPECT_NEAR(pixel->y(), 40.5, 1e-9);
  }
  const Camera camera = camera_from({1, -5, 2});
  EXPECT_FALSE(projected(camera, 2.0 * camera.from - camera.to).has_value());  // behind the eye
}

}  // namespace
}  // namespace knotlight
