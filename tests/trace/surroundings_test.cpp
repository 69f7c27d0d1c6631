#include "trace/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "support/statistics.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

using std::numbers::pi;

std::unique_ptr<RayCaster> caster_of(const Scene& scene) {
  std::vector<const Shape*> shapes;
  for (const Object& object : scene.objects) shapes.push_back(&object.shape);
  return std::make_unique<RayCaster>(shapes);
}

Object diffuse(Shape shape, const Spectrum& reflectance) {
  return {"diffuse", std::move(shape), DiffuseMaterial{reflectance}};
}

Object clear(Shape shape, double sigma_a, double ior) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(sigma_a);
  material.ior = ior;
  return {"translucent", std::move(shape), material};
}

// Vertex colours that are linear in x and y are reproduced exactly by interpolation.
TEST(Surroundings, ReflectanceFollowsTheColoursOfTheVertices) {
  TriangleMesh quad = quad_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0));
  for (const Vec3& v : quad.vertices)
    quad.colours.emplace_back(0.5 + 0.25 * v.x(), 0.5 + 0.125 * v.y(), 1.0);
  Scene scene;
  scene.objects = {diffuse(quad, Spectrum(0.8, 0.4, 0.2)), clear(Sphere{Vec3(9, 0, 0), 1.0}, 1, 1)};
  const auto caster = caster_of(scene);
  for (const double x : {-0.9, -0.1, 0.7})
    for (const double y : {-1.7, 0.3, 1.9}) {
      const auto hit = caster->nearest({Vec3(x, y, 5), -Vec3::UnitZ()});
      const Spectrum expected =
          Spectrum(0.8, 0.4, 0.2) * Spectrum(0.5 + 0.25 * x, 0.5 + 0.125 * y, 1.0);
      EXPECT_LT((reflectance_at(scene.objects[0], *hit) - expected).abs().maxCoeff(), 1e-12);
    }
  const auto ball = caster->nearest({Vec3(9, 0, 5), -Vec3::UnitZ()});
  EXPECT_TRUE((reflectance_at(scene.objects[1], *ball) == 0.0).all());
}

TEST(Surroundings, ReflectIfAnyDiffuseObjectDoes) {
  Scene scene;
  scene.objects = {clear(Sphere{}, 1.0, 1.0), diffuse(Sphere{}, Spectrum::Zero())};
  EXPECT_FALSE(surroundings_reflect(scene));
  scene.objects.push_back(diffuse(Sphere{}, Spectrum(0, 0, 0.1)));
  EXPECT_TRUE(surroundings_reflect(scene));
}

// Inside a hollow sphere of reflectance rho with a lamp of intensity I at its centre the wall gets
// E = I/R^2 (1 + rho + rho^2 + ...) everywhere, so its radiance is rho I / (pi R^2 (1 - rho)). 40
// 000 independent paths, within 4.892 standard errors: a false alarm once in a million.
TEST(Surroundings, HollowSphereIsAGeometricSeries) {
  constexpr double rho = 0.6, R = 2.0, I = 3.0;
  Scene scene;
  scene.objects = {diffuse(Sphere{Vec3::Zero(), R}, Spectrum::Constant(rho))};
  scene.lights = {PointLight{Vec3::Zero(), Spectrum::Constant(I)}};
  const auto caster = caster_of(scene);
  const Vec3 d = Vec3(1, 2, -1).normalized();
  const auto hit = caster->nearest({Vec3(0.1, 0.3, -0.2), d});
  Rng rng(1, Stream::tests, 0);
  test::Mean radiance;
  for (int i = 0; i < 40'000; ++i)
    radiance.add(reflected_radiance(scene, *caster, *hit, d, rng)[0]);
  EXPECT_NEAR(radiance.mean(), rho * I / (pi * R * R * (1.0 - rho)),
              test::z_one_in_a_million * radiance.standard_error());
  EXPECT_LT(radiance.standard_error(), 0.01 * radiance.mean());
}

// A small plate at height h over the middle of a table that is lit evenly at right angles with
// irradiance E gets rho E F on its lower side, F = form factor of the table. 40 000 samples, a
// false alarm once in a million.
TEST(Surroundings, IrradianceAboveALitSquare) {
  constexpr double s = 2.0, h = 1.0, E = 1.7, rho = 0.5;
  Scene scene;
  scene.objects = {
      diffuse(quad_mesh(Vec3::Zero(), Vec3(s, 0, 0), Vec3(0, s, 0)), Spectrum::Constant(rho))};
  scene.lights = {DirectionalLight{-Vec3::UnitZ(), Spectrum::Constant(E)}};
  const auto caster = caster_of(scene);
  // A differential plate parallel to a rectangle a x b with a corner below it, A = a/h, B = b/h:
  // F = (1/2pi) (A/sqrt(1+A^2) atan(B/sqrt(1+A^2)) + B/sqrt(1+B^2) atan(A/sqrt(1+B^2))). Four of
  // them, A = B.
  const double x = s / h;
  const double w = std::sqrt(1.0 + x * x);
  const double F = 4.0 / pi * (x / w) * std::atan(x / w);
  Rng rng(1, Stream::tests, 1);
  test::Mean irradiance;
  for (int i = 0; i < 40'000; ++i)
    irradiance.add(
        sample_surroundings_irradiance(scene, *caster, Vec3(0, 0, h), -Vec3::UnitZ(), rng)[0]);
  EXPECT_NEAR(irradiance.mean(), rho * E * F,
              test::z_one_in_a_million * irradiance.standard_error());
  // The other side sees nothing of it.
  EXPECT_EQ(sample_surroundings_irradiance(scene, *caster, Vec3(0, 0, h), Vec3::UnitZ(), rng)[0],
            0.0);
}

// A table lit at right angles through a plate of optical thickness tau: index-matched it weakens
// the light, refracting it ends the straight way.
TEST(Surroundings, IndexMatchedObjectsAreSeenThrough) {
  constexpr double tau = 0.7, rho = 0.8;
  const auto radiance = [&](double ior) {
    Scene scene;
    scene.objects = {
        diffuse(quad_mesh(Vec3::Zero(), Vec3(9, 0, 0), Vec3(0, 9, 0)), Spectrum::Constant(rho)),
        clear(box_mesh(Vec3(-9, -9, 1), Vec3(9, 9, 2)), tau, ior)};
    scene.lights = {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}};
    const auto caster = caster_of(scene);
    const auto hit = caster->nearest({Vec3(0.1, 0.2, 0.5), -Vec3::UnitZ()});
    Rng rng(1, Stream::tests, 2);
    return reflected_radiance(scene, *caster, *hit, -Vec3::UnitZ(), rng)[0];
  };
  EXPECT_NEAR(radiance(1.0), rho / pi * std::exp(-tau), 1e-12);
  EXPECT_EQ(radiance(1.5), 0.0);
}

// An index-matched box stands on a table, their surfaces coincide. A path that comes down through
// the box ends at the table, although a search from the box's bottom would skip it: of the lamp
// below, nothing is to be seen.
TEST(Surroundings, NoLightFromBelowTheTable) {
  Scene scene;
  scene.objects = {
      diffuse(quad_mesh(Vec3::Zero(), Vec3(9, 0, 0), Vec3(0, 9, 0)), Spectrum::Constant(0.5)),
      clear(box_mesh(Vec3(-5, -5, 0), Vec3(5, 5, 1)), 0.1, 1.0),
      diffuse(quad_mesh(Vec3(0, 0, 3), Vec3(1, 0, 0), Vec3(0, 1, 0)), Spectrum::Ones()),
      diffuse(quad_mesh(Vec3(0, 0, -3), Vec3(9, 0, 0), Vec3(0, 9, 0)), Spectrum::Ones()),
      diffuse(Sphere{Vec3::Zero(), 8.0}, Spectrum::Zero())};  // nothing goes around the table
  scene.lights = {PointLight{Vec3(0, 0, -2), Spectrum::Constant(1e3)}};
  const auto caster = caster_of(scene);
  const auto hit = caster->nearest({Vec3(0.1, 0.2, 2), Vec3::UnitZ()});
  Rng rng(1, Stream::tests, 3);
  for (int i = 0; i < 2000; ++i)
    ASSERT_EQ(reflected_radiance(scene, *caster, *hit, Vec3::UnitZ(), rng)[0], 0.0) << i;
}

}  // namespace
}  // namespace knotlight
