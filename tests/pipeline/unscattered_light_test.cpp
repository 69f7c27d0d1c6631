#include "pipeline/unscattered_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-6;  // the ray caster steps off surfaces by 1e-7 of the scene's size

// Bodies of one medium under lights.
struct Lit {
  Scene scene;
  std::unique_ptr<RayCaster> caster;

  Lit(const std::vector<std::pair<Shape, Material>>& bodies, const std::vector<Light>& lights) {
    scene.lights = lights;
    for (const auto& [shape, material] : bodies) scene.objects.push_back({"", shape, material});
    std::vector<const Shape*> shapes;
    for (const Object& object : scene.objects) shapes.push_back(&object.shape);
    caster = std::make_unique<RayCaster>(shapes);
  }
  // What is below the surface that a ray from `eye` along `direction` meets first.
  UnscatteredLight seen(const Vec3& eye, const Vec3& direction, int samples,
                        std::uint64_t index = 0) const {
    Rng rng(7, Stream::tests, index);
    return unscattered_light(scene, *caster, *caster->nearest({eye, direction}), samples, rng);
  }
};

TranslucentMaterial medium(double ior = 1.0) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum(0.1, 0.2, 0.3);
  material.sigma_s = Spectrum::Constant(1.0);
  material.ior = ior;
  return material;
}

// E / (4 pi) where the beam enters, exp(-sigma_t length) of it where it leaves.
TEST(UnscatteredLight, ABeamThroughABall) {
  const Spectrum E(1.0, 2.0, 3.0);
  const Lit lit({{Sphere{Vec3::Zero(), 1.0}, medium()}}, {DirectionalLight{-Vec3::UnitZ(), E}});
  for (const double x : {0.0, 0.3, -0.8}) {
    const double z = std::sqrt(1.0 - x * x);
    const Spectrum passed = (-Spectrum(1.1, 1.2, 1.3) * 2.0 * z).exp();
    const UnscatteredLight lit_side = lit.seen({x, 0, 5}, -Vec3::UnitZ(), 1);
    const UnscatteredLight far_side = lit.seen({x, 0, -5}, Vec3::UnitZ(), 1);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(lit_side.U_ri[c], E[c] / (4.0 * pi), rounding);
      EXPECT_NEAR(lit_side.F_ri[c], -E[c] * z, rounding);
      EXPECT_NEAR(far_side.U_ri[c], E[c] * passed[c] / (4.0 * pi), rounding);
      EXPECT_NEAR(far_side.F_ri[c], E[c] * passed[c] * z, rounding);
    }
  }
}

// A light's intensity over the square of its distance, and none in the shadow of a diffuse body.
TEST(UnscatteredLight, APointLightAndAShadow) {
  const PointLight lamp{{0, 0, 4}, Spectrum::Constant(18.0)};
  const Lit lit({{Sphere{Vec3::Zero(), 1.0}, medium()}}, {lamp});
  EXPECT_NEAR(lit.seen({0, 0, 2}, -Vec3::UnitZ(), 1).U_ri[0], 18.0 / 9.0 / (4.0 * pi), rounding);
  const Lit shaded({{Sphere{Vec3::Zero(), 1.0}, medium()},
                    {Sphere{{0, 0, 3}, 0.5}, DiffuseMaterial{Spectrum::Zero()}}},
                   {lamp});
  EXPECT_EQ(shaded.seen({0, 0, 2}, -Vec3::UnitZ(), 1).U_ri[0], 0.0);
}

// At normal incidence the irradiance passes undirected; at an angle it is spread by the ratio of
// cosines.
TEST(UnscatteredLight, ABeamIntoARefractingBall) {
  const double ior = 1.4;
  const Lit lit({{Sphere{Vec3::Zero(), 1.0}, medium(ior)}},
                {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}});
  for (const double x : {0.0, 0.6}) {
    const double cosine = std::sqrt(1.0 - x * x);
    const double inside = std::sqrt(1.0 - x * x / (ior * ior));
    const double T = 1.0 - fresnel_reflectance(cosine, ior);
    const UnscatteredLight light = lit.seen({x, 0, 5}, -Vec3::UnitZ(), 1);
    EXPECT_NEAR(light.U_ri[0], T * cosine / inside / (4.0 * pi), rounding);
    EXPECT_NEAR(light.F_ri[0], -T * cosine, rounding);
  }
  EXPECT_EQ(lit.seen({0, 0, -5}, Vec3::UnitZ(), 1).U_ri[0], 0.0);
}

// A sky of radiance 1 over a ball: half of all directions see it, the others through chords of
// length 2 mu: 1/2 + 1/2 int_0^1 exp(-2 sigma_t mu) dmu. With an index the radiance inside is
// T ior^2 within the critical cone: 1/2 int T(mu') mu' / mu_inside dmu' over the outer cosine.
// 4000 places x 16 samples of variance below 1/4 (1, matched), 2 (refracting): standard errors
// below 0.002 and 0.006; 5 of them: false alarms below 1e-6.
TEST(UnscatteredLight, ASkyOverABall) {
  const EnvironmentLight sky{Spectrum::Ones(), nullptr};
  const auto mean_U = [&](double ior) {
    const Lit lit({{Sphere{Vec3::Zero(), 1.0}, medium(ior)}}, {sky});
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 4000; ++i)
      sum += lit.seen({0.3, 0.2, 5}, -Vec3::UnitZ(), 16, i).U_ri[0];
    return sum / 4000.0;
  };
  const double sigma_t = 1.1;
  EXPECT_NEAR(mean_U(1.0), 0.5 + 0.25 * (1.0 - std::exp(-2.0 * sigma_t)) / sigma_t, 5 * 0.002);
  double refracted = 0.0;
  constexpr int steps = 10000;
  for (int i = 0; i < steps; ++i) {
    const double mu = (i + 0.5) / steps;
    refracted += 0.5 * (1.0 - fresnel_reflectance(mu, 1.4)) * mu /
                 std::sqrt(1.0 - (1.0 - mu * mu) / 1.96) / steps;
  }
  EXPECT_NEAR(mean_U(1.4), refracted, 5 * 0.006);
}

// A small dense box above a wide floor that a beam lights: its lower side sees the floor's radiance
// rho E / pi over the solid angle of a square of half-width a at distance h, 4 asin(a^2 / (a^2 +
// h^2)), and nothing else. The box shades 4e-6 of the floor in sight. 64000 samples of a variance
// below (rho E / pi)^2 / 4 = 0.0016: standard error below 2e-4.
TEST(UnscatteredLight, LightFromTheFloor) {
  TranslucentMaterial dense = medium();
  dense.sigma_s = Spectrum::Constant(1e5);
  const double a = 3.0, h = 1.0;
  const Lit lit(
      {{box_mesh({-0.001, -0.001, 0}, {0.001, 0.001, 0.002}), dense},
       {quad_mesh({0, 0, -h}, {a, 0, 0}, {0, a, 0}), DiffuseMaterial{Spectrum::Constant(0.5)}}},
      {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}});
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 1000; ++i)
    sum += lit.seen({2e-4, 1e-4, -0.5}, Vec3::UnitZ(), 64, i).U_ri[0];
  const double solid_angle = 4.0 * std::asin(a * a / (a * a + h * h));
  EXPECT_NEAR(sum / 1000.0, 0.5 / pi * solid_angle / (4.0 * pi), 5 * 2e-4);
}

}  // namespace
}  // namespace knotlight
