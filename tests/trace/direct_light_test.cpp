#include "trace/direct_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::Mean;
using test::z_one_in_a_million;

Object make_object(const Shape& shape, const Material& material) {
  return {"object", shape, material};
}

TranslucentMaterial wax(double sigma_a, double sigma_s, double ior) {
  TranslucentMaterial m;
  m.sigma_a = Spectrum::Constant(sigma_a);
  m.sigma_s = Spectrum::Constant(sigma_s);
  m.ior = ior;
  return m;
}

RayCaster caster_for(const Scene& scene) {
  std::vector<const Shape*> shapes;
  for (const Object& object : scene.objects) shapes.push_back(&object.shape);
  return RayCaster(shapes);
}

double irradiance(const Scene& scene, const RayCaster& caster) {
  Rng rng(1, Stream::tests, 0);
  return sample_irradiance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), rng)[0];
}

// I cos / d^2 at height 2, 60 degrees off: 8 * 0.5 / 16.
TEST(DirectLight, PointAndDirectionalLight) {
  Scene scene;
  scene.lights = {PointLight{Vec3(2.0 * std::sqrt(3.0), 0, 2), Spectrum::Constant(8.0)}};
  EXPECT_NEAR(irradiance(scene, caster_for(scene)), 0.25, 1e-14);
  scene.lights = {DirectionalLight{Vec3(0, 0.6, -0.8), Spectrum::Constant(5.0)}};
  EXPECT_NEAR(irradiance(scene, caster_for(scene)), 4.0, 1e-14);
  scene.lights = {DirectionalLight{Vec3(0, 0, 1), Spectrum::Constant(5.0)}};
  EXPECT_EQ(irradiance(scene, caster_for(scene)), 0.0);
}

// A square light of half side a at height h above the point, parallel to it: the form factor of a
// differential element to a rectangle, four quarters of
// (1/2pi) [X/sqrt(1+X^2) atan(Y/sqrt(1+X^2)) + Y/sqrt(1+Y^2) atan(X/sqrt(1+Y^2))], X = Y = a/h.
// 100 000 samples, false-alarm rate 1e-6.
TEST(DirectLight, AreaLightMatchesTheFormFactor) {
  Scene scene;
  scene.lights = {
      AreaLight{Vec3(0, 0, 1.5), Vec3(0, 1, 0), Vec3(1, 0, 0), Spectrum::Constant(3.0)}};
  const RayCaster caster = caster_for(scene);
  const double x = 1.0 / 1.5;
  const double root = std::sqrt(1.0 + x * x);
  const double form_factor = 4.0 / (2.0 * pi) * 2.0 * (x / root) * std::atan(x / root);
  Mean e;
  Rng rng(2, Stream::tests, 0);
  for (int i = 0; i < 100'000; ++i)
    e.add(sample_irradiance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), rng)[0]);
  EXPECT_LT(std::abs(e.mean() - pi * 3.0 * form_factor), z_one_in_a_million * e.standard_error());
  // From behind it is dark: u x v points the other way.
  scene.lights = {
      AreaLight{Vec3(0, 0, 1.5), Vec3(1, 0, 0), Vec3(0, 1, 0), Spectrum::Constant(3.0)}};
  EXPECT_EQ(irradiance(scene, caster), 0.0);
}

// A constant sky gives pi L, noiselessly where nothing is in the way.
TEST(DirectLight, ConstantEnvironment) {
  Scene scene;
  scene.lights = {EnvironmentLight{Spectrum::Constant(2.0), nullptr}};
  EXPECT_NEAR(irradiance(scene, caster_for(scene)), 2.0 * pi, 1e-12);
}

// A map that is bright in one band, against the integral over the band: L between 45 degrees from
// the zenith and the zenith gives pi L sin^2(45 degrees). The map has 256 rows, of which bilinear
// interpolation blurs one border row: 1 %.
TEST(DirectLight, MappedEnvironment) {
  constexpr int width = 64;
  constexpr int height = 256;
  std::vector<Spectrum> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels.push_back(Spectrum::Constant(y < height / 4 ? 1.0 : 0.0));
  Scene scene;
  scene.lights = {EnvironmentLight{Spectrum::Constant(1.0),
                                   std::make_shared<EnvironmentMap>(width, height, pixels)}};
  const RayCaster caster = caster_for(scene);
  Mean e;
  Rng rng(3, Stream::tests, 0);
  for (int i = 0; i < 50'000; ++i)
    e.add(sample_irradiance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), rng)[0]);
  EXPECT_NEAR(e.mean(), 0.5 * pi, 0.01 * pi + z_one_in_a_million * e.standard_error());
}

// Beer-Lambert through an index-matched ball, nothing through a refracting or a diffuse one.
TEST(DirectLight, ShadowsOfTranslucentObjects) {
  Scene scene;
  const Shape ball = Sphere{Vec3(0, 0, 3), 1.0};
  scene.objects = {make_object(ball, wax(0.1, 0.4, 1.0))};
  const RayCaster caster = caster_for(scene);
  const Spectrum through = transmittance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), 10.0);
  EXPECT_NEAR(through[1], std::exp(-1.0), 1e-12);
  const Spectrum half_way = transmittance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), 3.0);
  EXPECT_NEAR(half_way[1], std::exp(-0.5), 1e-6);
  EXPECT_TRUE((transmittance(scene, caster, Vec3::Zero(), Vec3::UnitX(), 10.0) == 1.0).all());
  scene.objects[0].material = wax(0.1, 0.4, 1.3);
  EXPECT_TRUE((transmittance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), 10.0) == 0.0).all());
  scene.objects[0].material = DiffuseMaterial{Spectrum::Constant(0.5)};
  EXPECT_TRUE((transmittance(scene, caster, Vec3::Zero(), Vec3::UnitZ(), 10.0) == 0.0).all());
}

TEST(DirectLight, AreaLightsAreSeenFromTheirFront) {
  Scene scene;
  scene.lights = {AreaLight{Vec3(0, 0, 5), Vec3(0, 1, 0), Vec3(1, 0, 0), Spectrum::Constant(3.0)}};
  EXPECT_EQ((*area_light_seen(scene, {Vec3(0.9, 0.9, 0), Vec3::UnitZ()}))[0], 3.0);
  EXPECT_EQ((*area_light_seen(scene, {Vec3(0.9, 0.9, 9), -Vec3::UnitZ()}))[0], 0.0);
  EXPECT_FALSE(area_light_seen(scene, {Vec3(1.1, 0, 0), Vec3::UnitZ()}));
  EXPECT_FALSE(area_light_seen(scene, {Vec3::Zero(), Vec3::UnitZ(), 4.0}));
}

}  // namespace
}  // namespace knotlight
