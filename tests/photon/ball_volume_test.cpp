#include "photon/ball_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Of the ball's volume; what ball_volume_inside promises.
constexpr double tolerance = 0.01;

double ball(double r) {
  return 4.0 / 3.0 * pi * r * r * r;
}

// Part of a ball of radius r on the inner side of a plane at distance d inside of which its centre
// lies: r^3 pi (2/3 + s - s^3/3), s = d/r.
double beside_plane(double r, double d) {
  const double s = d / r;
  return pi * r * r * r * (2.0 / 3.0 + s - s * s * s / 3.0);
}

class BallVolume : public ::testing::Test {
 protected:
  Shape box_ = box_mesh(Vec3(-3, -3, -3), Vec3(3, 3, 3));
  Shape sphere_ = Sphere{Vec3(1, 2, 3), 2.0};
  RayCaster caster_{{&box_, &sphere_}};
};

TEST_F(BallVolume, FarFromTheSurfaceIsExact) {
  EXPECT_DOUBLE_EQ(ball_volume_inside(Vec3(0.5, 0, 0), 1.0, caster_, 0), ball(1.0));
  EXPECT_DOUBLE_EQ(ball_volume_inside(Vec3(1, 2, 3), 1.9, caster_, 1), ball(1.9));
}

TEST_F(BallVolume, HalfBallOnAFaceWhateverTheRounding) {
  for (const double off : {0.0, 1e-13, -1e-13, 1e-9, -1e-9})
    EXPECT_NEAR(ball_volume_inside(Vec3(0.3, 0.2, 3.0 + off), 0.5, caster_, 0), 0.5 * ball(0.5),
                3e-4 * ball(0.5));
}

TEST_F(BallVolume, CapAtADistance) {
  for (const double d : {0.05, 0.2, 0.35, 0.49})
    EXPECT_NEAR(ball_volume_inside(Vec3(0.3, 3.0 - d, 0.7), 0.5, caster_, 0), beside_plane(0.5, d),
                tolerance * ball(0.5));
}

TEST_F(BallVolume, EdgesAndCorners) {
  for (const double x : {-3.0, 3.0}) {
    for (const double y : {-3.0, 3.0}) {
      EXPECT_NEAR(ball_volume_inside(Vec3(x, y, 0.1), 0.5, caster_, 0), 0.25 * ball(0.5),
                  tolerance * ball(0.5));
      for (const double z : {-3.0, 3.0})
        EXPECT_NEAR(ball_volume_inside(Vec3(x, y, z), 0.5, caster_, 0), 0.125 * ball(0.5),
                    tolerance * ball(0.5));
    }
  }
}

// A ball as large as the object and larger: both faces of a slab, or all of the object.
TEST_F(BallVolume, WholeObject) {
  EXPECT_NEAR(ball_volume_inside(Vec3(1, 2, 3), 2.5, caster_, 1), ball(2.0), tolerance * ball(2.0));
}

// Lens of two spheres at distance d: pi (R+r-d)^2 (d^2 + 2d(r+R) - 3(r-R)^2) / (12 d).
TEST_F(BallVolume, LensOfTwoSpheres) {
  const double R = 2.0;
  for (const double r : {0.3, 1.0}) {
    for (const double d : {1.8, 2.0}) {
      const double exact = pi * std::pow(R + r - d, 2) *
                           (d * d + 2.0 * d * (r + R) - 3.0 * (r - R) * (r - R)) / (12.0 * d);
      for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -0.6, 0.8)})
        EXPECT_NEAR(ball_volume_inside(Vec3(1, 2, 3) + d * n, r, caster_, 1), exact,
                    tolerance * ball(r));
    }
  }
}

// Smooth kernel (1 - s^2)^2 on a plane face: half of 4 pi r^3 (1/3 - 2/5 + 1/7), and its first
// moment along the inward normal, 2 pi r^4 (1/4 - 1/3 + 1/8) / 2.
TEST_F(BallVolume, SmoothKernelOnAFace) {
  const double r = 0.5;
  const KernelMoments m =
      kernel_moments_inside(Vec3(0.3, 0.2, 3.0), r, RadialKernel::smooth, caster_, 0);
  const double whole = 4.0 * pi * r * r * r * 8.0 / 105.0;
  EXPECT_NEAR(m.mass, 0.5 * whole, 1e-3 * whole);
  EXPECT_NEAR(m.first.z(), -pi * r * r * r * r / 24.0, 0.01 * r * whole);
  EXPECT_LT(m.first.head<2>().norm(), 0.01 * r * whole);
  EXPECT_NEAR(kernel_moments_inside(Vec3(0.3, 0.2, 2.0), r, RadialKernel::smooth, caster_, 0).mass,
              whole, 1e-12);
}

// The ball's centroid in the half of it: 3/8 of the radius inside.
TEST_F(BallVolume, CentroidOfHalfABall) {
  const KernelMoments m =
      kernel_moments_inside(Vec3(3.0, 0.1, 0.2), 0.4, RadialKernel::ball, caster_, 0);
  EXPECT_NEAR((m.first / m.mass).x(), -0.375 * 0.4, 0.01 * 0.4);
}

}  // namespace
}  // namespace knotlight
