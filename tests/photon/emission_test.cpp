// The power that photons carry through test surfaces against closed forms, light by light. The
// surfaces lie inside the target sphere, where the emitter promises to be unbiased.
#include "photon/emission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "photon/photon_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::parallel_light;
using testing_scenes::sigmas;
using testing_scenes::sky;

constexpr std::uint64_t photons = 100'000;  // per check

// Cube of half side 1 around the origin: the target sphere has radius sqrt 3.
Bounds unit_target() {
  Bounds b;
  b.extend(Vec3(-1, -1, -1));
  b.extend(Vec3(1, 1, 1));
  return b;
}
const double target_radius = std::sqrt(3.0);
Sphere target_sphere() {
  return {Vec3::Zero(), target_radius};
}

// Expects the mean power over rays with `counts` to be `exact`, within 5 standard errors.
void expect_flux(const std::vector<Light>& lights, const std::function<bool(const Ray&)>& counts,
                 double exact, const Bounds& scene_bounds = unit_target(), int channel = 0) {
  const Emitter emitter(lights, channel, target_sphere(), scene_bounds);
  ASSERT_TRUE(emitter.any());
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t i = 0; i < photons; ++i) {
    Rng rng(7, Stream::tests, i);
    const EmittedPhoton p = emitter.sample(rng);
    EXPECT_NEAR(p.direction.norm(), 1.0, 1e-12);
    const double power = counts({p.origin, p.direction}) ? p.power : 0.0;
    sum += power;
    squares += power * power;
  }
  const double n = static_cast<double>(photons);
  const double mean = sum / n;
  const double standard_error = std::sqrt(std::max(0.0, squares / n - mean * mean) / n);
  constexpr double rounding = 1e-9;  // relative; equal powers may have no spread at all
  EXPECT_NEAR(mean, exact, sigmas * standard_error + rounding * exact);
}

// Rays that pass the disc with the given normal from the side the normal points to.
std::function<bool(const Ray&)> through_disc(const Vec3& center, const Vec3& normal,
                                             double radius) {
  return [=](const Ray& ray) {
    const double cosine = ray.direction.dot(normal);
    if (cosine >= 0.0) return false;
    const double t = (center - ray.origin).dot(normal) / cosine;
    return t > 0.0 && (ray.origin + t * ray.direction - center).norm() < radius;
  };
}

bool meets_target(const Ray& ray) {
  const double along = -ray.origin.dot(ray.direction);
  const bool from_inside = ray.origin.norm() < target_radius;
  // 1e-9: rays along the rim of the cone may miss by rounding.
  return from_inside || (along > 0.0 && (ray.origin + along * ray.direction).norm() <
                                            target_radius * (1.0 + 1e-9));
}

TEST(Emission, PointLightFillsTheConeOfTheTarget) {
  for (const double distance : {2.0, 5.0, 1e7}) {
    const PointLight light{Vec3(0, 0.6, 0.8) * distance, Spectrum::Constant(18.0)};
    const double sine = target_radius / distance;
    const double deficit = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));  // 1 - cos
    expect_flux({light}, meets_target, 18.0 * 2.0 * pi * deficit);
  }
}

TEST(Emission, PointLightInsideTheTargetShinesEverywhere) {
  const PointLight light{Vec3(0.5, 0, 0), Spectrum::Constant(2.0)};
  expect_flux({light}, meets_target, 2.0 * 4.0 * pi);
  // Disc seen under the half angle atan(0.5/1).
  const double cosine = 1.0 / std::sqrt(1.25);
  expect_flux({light}, through_disc(Vec3(0.5, 0, -1), Vec3::UnitZ(), 0.5),
              2.0 * 2.0 * pi * (1.0 - cosine));
}

TEST(Emission, PointLightOnADisc) {
  const PointLight light{Vec3(0, 0, 4), Spectrum::Constant(18.0)};
  const double a = 0.4;
  expect_flux({light}, through_disc(Vec3::Zero(), Vec3::UnitZ(), a),
              18.0 * 2.0 * pi * (1.0 - 4.0 / std::sqrt(16.0 + a * a)));
}

TEST(Emission, DirectionalLight) {
  const DirectionalLight light = parallel_light(Vec3(1, 2, -2), 3.0);
  expect_flux({light}, meets_target, 3.0 * pi * 3.0);
  const double cosine = 2.0 / 3.0;
  expect_flux({light}, through_disc(Vec3(0.2, 0.3, 0.1), Vec3::UnitZ(), 0.5),
              3.0 * pi * 0.25 * cosine);
}

TEST(Emission, ConstantEnvironment) {
  expect_flux({sky(0.7)}, meets_target, 0.7 * 4.0 * pi * pi * 3.0);
  const Vec3 n = Vec3(1, -1, 2).normalized();
  expect_flux({sky(0.7)}, through_disc(Vec3(0.1, 0.4, -0.2), n, 0.5), 0.7 * pi * pi * 0.25);
}

// Irradiance of a horizontal disc under a map that is 1 above the horizon and 0 below, but for the
// interpolation across the two rows next to it: integral of L(theta) cos over the upper half by
// the midpoint rule.
TEST(Emission, EnvironmentMap) {
  constexpr int width = 16;
  constexpr int height = 8;
  std::vector<Spectrum> pixels(width * height, Spectrum::Zero());
  for (int i = 0; i < width * height / 2; ++i)
    pixels[static_cast<std::size_t>(i)] = Spectrum(1.0, 0.5, 2.0);
  EnvironmentLight light{Spectrum::Constant(0.7),
                         std::make_shared<EnvironmentMap>(width, height, pixels)};
  for (const int channel : {0, 1}) {
    double above = 0.0;
    double below = 0.0;
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
      const double theta = pi * (i + 0.5) / steps;
      const double L =
          0.7 * light.map->radiance(Vec3(std::sin(theta), 0, std::cos(theta)))[channel];
      const double term = L * 2.0 * pi * std::sin(theta) * std::cos(theta) * pi / steps;
      (theta < pi / 2.0 ? above : below) += std::abs(term);
    }
    const double disc = pi * 0.25;
    expect_flux({light}, through_disc(Vec3(0.1, 0.4, 0), Vec3::UnitZ(), 0.5), disc * above,
                unit_target(), channel);
    expect_flux({light}, through_disc(Vec3(0.1, 0.4, 0), -Vec3::UnitZ(), 0.5), disc * below,
                unit_target(), channel);
  }
}

// Form factor between equal parallel a x b rectangles facing each other at distance c:
//   F = 2/(pi X Y) { ln sqrt((1+X^2)(1+Y^2)/(1+X^2+Y^2)) + X sqrt(1+Y^2) atan(X/sqrt(1+Y^2))
//       + Y sqrt(1+X^2) atan(Y/sqrt(1+X^2)) - X atan X - Y atan Y },  X = a/c, Y = b/c.
// Flux from one to the other: pi L a b F.
double rectangle_form_factor(double X, double Y) {
  const double x1 = std::sqrt(1.0 + X * X);
  const double y1 = std::sqrt(1.0 + Y * Y);
  return 2.0 / (pi * X * Y) *
         (std::log(x1 * y1 / std::sqrt(1.0 + X * X + Y * Y)) + X * y1 * std::atan(X / y1) +
          Y * x1 * std::atan(Y / x1) - X * std::atan(X) - Y * std::atan(Y));
}

// Near: hemisphere sampling; far: the cone of the target.
TEST(Emission, AreaLightOntoAnEqualRectangle) {
  for (const double distance : {1.0, 6.0}) {
    const AreaLight light{Vec3(0, 0, distance), Vec3(0.8, 0, 0), Vec3(0, -0.5, 0),
                          Spectrum::Constant(5.0)};
    const auto onto = [](const Ray& ray) {
      if (ray.direction.z() >= 0.0) return false;
      const Vec3 p = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
      return ray.origin.z() > 0.0 && std::abs(p.x()) < 0.8 && std::abs(p.y()) < 0.5;
    };
    const double F = rectangle_form_factor(1.6 / distance, 1.0 / distance);
    expect_flux({light}, onto, 5.0 * pi * 1.6 * 1.0 * F);
  }
}

// A small light sends pi L A (R/D)^2 cos theta into a sphere of radius R at distance D that lies
// wholly before it, theta = the angle of its normal to the line of centres.
TEST(Emission, TiltedAreaLightOntoTheWholeTarget) {
  constexpr double half_side = 1e-3;  // changes the flux by parts in 1e6
  const double theta = 1.0;
  const AreaLight light{Vec3(0, 0, 6), half_side * Vec3(std::cos(theta), 0, -std::sin(theta)),
                        half_side * -Vec3::UnitY(), Spectrum::Constant(5e6)};
  EXPECT_NEAR(light.normal().z(), -std::cos(theta), 1e-12);
  expect_flux({light}, meets_target,
              pi * 5e6 * 4.0 * half_side * half_side * 3.0 / 36.0 * std::cos(theta));
}

TEST(Emission, AreaLightShinesFromOneSideOnly) {
  const AreaLight away{Vec3(0, 0, 6), Vec3(1, 0, 0), Vec3(0, 1, 0), Spectrum::Constant(5.0)};
  EXPECT_FALSE(Emitter({away}, 0, target_sphere(), unit_target()).any());
  // Edge on, half of the target is lit.
  const AreaLight edge_on{Vec3(0, 0, 6), Vec3(0, 0.1, 0), Vec3(0, 0, 0.1), Spectrum::Constant(5.0)};
  const std::vector<Light> lights{edge_on};
  const Emitter emitter(lights, 0, target_sphere(), unit_target());
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Rng rng(7, Stream::tests, i);
    const EmittedPhoton p = emitter.sample(rng);
    EXPECT_EQ(p.power > 0.0, p.direction.x() > 0.0);
  }
}

// The choice among lights must not move the mean: the flux of all is the sum of the single ones.
TEST(Emission, ManyLightsAddUp) {
  const PointLight point{Vec3(0, 0, 4), Spectrum::Constant(18.0)};
  const DirectionalLight sun = parallel_light(Vec3(1, 0, -1), 2.0);
  const double a = 0.4;
  const double exact = 18.0 * 2.0 * pi * (1.0 - 4.0 / std::sqrt(16.0 + a * a)) +
                       2.0 * pi * a * a * std::sqrt(0.5) + 0.3 * pi * pi * a * a;
  const std::vector<Light> lights{point, sun, sky(0.3)};
  expect_flux(lights, through_disc(Vec3::Zero(), Vec3::UnitZ(), a), exact);

  const Emitter emitter(lights, 0, target_sphere(), unit_target());
  Rng rng(7, Stream::tests, 0);
  const double power = emitter.sample(rng).power;
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(emitter.sample(rng).power, power, 1e-9 * power);
}

TEST(Emission, RaysStartOutsideTheScene) {
  Bounds scene = unit_target();
  scene.extend(Vec3(10, 0, 0));
  const std::vector<Light> lights{parallel_light(Vec3(-1, 0.1, 0), 1.0), sky(1.0),
                                  PointLight{Vec3(1e6, 3, 2), Spectrum::Constant(1.0)}};
  const Emitter emitter(lights, 0, target_sphere(), scene);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Rng rng(7, Stream::tests, i);
    const double from_center = (emitter.sample(rng).origin - scene.center()).norm();
    EXPECT_GE(from_center, scene.radius());
    EXPECT_LT(from_center, 5.0 * scene.radius());
  }
}

TEST(Emission, NoLightNoPhotons) {
  EXPECT_FALSE(Emitter({}, 0, target_sphere(), unit_target()).any());
  const std::vector<Light> dark{sky(0.0)};
  EXPECT_FALSE(Emitter(dark, 0, target_sphere(), unit_target()).any());
}

}  // namespace
}  // namespace knotlight
