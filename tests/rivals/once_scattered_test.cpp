#include "rivals/once_scattered.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/phase_function.h"
#include "rival_scenes.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::beam;
using test::half_space;
using test::one_object;

// Mean over n rays with evenly spread depths.
test::Mean look(const PreparedScene& p, const Ray& ray, int n) {
  const auto hit = p.caster->nearest(ray);
  Rng rng(5, Stream::tests, 0);
  test::Mean mean;
  for (int i = 0; i < n; ++i)
    mean.add(once_scattered(p.scene, *p.caster, ray, *hit, hit->normal, (i + 0.5) / n, rng)[0]);
  return mean;
}

// A half-space under a beam sends back, in closed form,
//
//   L = T / ior^2  sigma_s p E T' (mu'/mu'_in) / (sigma_t (1 + mu_in / mu'_in)),
//
// by refraction exactly. The depth is drawn from the law of exp(-sigma_t s), and what remains of
// the integrand is linear in its sample: 4000 midpoints err by nothing but what is 24 mean free
// paths down and beside the body.
TEST(OnceScattered, HalfSpaceUnderABeam) {
  for (const double ior : {1.0, 1.4})
    for (const double g : {0.0, 0.7}) {
      const Medium m{0.3, 0.9, g, ior, 0.0};
      const Vec3 travel = Vec3(0.6, 0.0, -0.8);
      const PreparedScene p = half_space(m, beam(travel, 3.0));
      const Vec3 look_along = Vec3(0.0, 0.6, -0.8);
      const double mu_in = std::sqrt(1.0 - 0.36 / (ior * ior));
      const Vec3 travel_in(0.6 / ior, 0.0, -mu_in);
      const Vec3 leaves(0.0, -0.6 / ior, mu_in);
      const double T = 1.0 - fresnel_reflectance(0.8, ior);
      const double expected = T * T / (ior * ior) * 0.8 / mu_in * 0.9 *
                              henyey_greenstein(travel_in.dot(leaves), g) * 3.0 / (1.2 * 2.0);
      const double L = look(p, {Vec3(0.2, 0.1, 0.0) - 2.0 * look_along, look_along}, 4000).mean();
      EXPECT_NEAR(L, expected, 2e-4 * expected) << ior << " " << g;
    }
}

// The ball of the unit test of Gather: a beam along +x, seen along -z through the centre.
TEST(OnceScattered, BallUnderABeam) {
  const PreparedScene p =
      one_object(Sphere{Vec3::Zero(), 1.0}, {0.2, 1.5, 0.6, 1.0, 0.0}, beam(Vec3::UnitX(), 2.0));
  double expected = 0.0;
  constexpr int terms = 20'000;
  for (int i = 0; i < terms; ++i) {
    const double s = 2.0 * (i + 0.5) / terms;
    const double way = std::sqrt(std::max(0.0, 1.0 - (1.0 - s) * (1.0 - s)));
    expected += std::exp(-1.7 * (s + way)) * 2.0 / terms;
  }
  expected *= 1.5 * henyey_greenstein(0.0, 0.6) * 2.0;
  EXPECT_NEAR(look(p, {Vec3(0, 0, 3), -Vec3::UnitZ()}, 4000).mean(), expected, 2e-4 * expected);
}

// A lamp in a ball of index 1.4, 0.5 beside a ray that goes straight through the centre, where
// refraction turns nothing. It sends 2 / d^2 through the medium, with no surface on the way.
TEST(OnceScattered, LampInTheBody) {
  const PreparedScene p = one_object(Sphere{Vec3::Zero(), 1.0}, {0.5, 1.0, 0.0, 1.4, 0.0},
                                     PointLight{Vec3(0.5, 0, 0), Spectrum::Constant(2.0)});
  double expected = 0.0;
  constexpr int terms = 20'000;
  for (int i = 0; i < terms; ++i) {
    const double s = 2.0 * (i + 0.5) / terms;
    const double d = std::hypot(1.0 - s, 0.5);
    expected += std::exp(-1.5 * (s + d)) * 2.0 / (d * d) / (4.0 * pi) * 2.0 / terms;
  }
  expected *= (1.0 - fresnel_reflectance(1.0, 1.4)) / (1.4 * 1.4);
  EXPECT_NEAR(look(p, {Vec3(0, 0, 3), -Vec3::UnitZ()}, 4000).mean(), expected, 2e-4 * expected);
}

// Under an even sky of radiance 1 light arrives at a depth s below the ball's pole, a = 1 - s from
// the centre, through the lengths -a c + sqrt(1 - a^2 (1 - c^2)): midpoint sums over the cosine c
// and s. 100 000 rays, five standard errors: a false alarm once in two million.
TEST(OnceScattered, BallUnderTheSky) {
  const PreparedScene p = one_object(Sphere{Vec3::Zero(), 1.0}, {0.5, 2.0, 0.0, 1.0, 0.0},
                                     EnvironmentLight{Spectrum::Constant(1.0), nullptr});
  double expected = 0.0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double s = 2.0 * (i + 0.5) / steps;
      const double a = 1.0 - s;
      const double c = 2.0 * (j + 0.5) / steps - 1.0;
      const double length = -a * c + std::sqrt(1.0 - a * a * (1.0 - c * c));
      expected += 2.0 * std::exp(-2.5 * (s + length)) / steps * (2.0 / steps) / 2.0;
    }
  expected *= 2.0;  // sigma_s
  const test::Mean mean = look(p, {Vec3(0, 0, 3), -Vec3::UnitZ()}, 100'000);
  EXPECT_NEAR(mean.mean(), expected, 5.0 * mean.standard_error());
  EXPECT_LT(mean.standard_error(), 0.01 * expected);
}

// Three channels at once are what each is alone: 20 000 rays, five standard errors.
TEST(OnceScattered, ChannelsAreIndependent) {
  Scene scene;
  TranslucentMaterial wax = test::material({0.2, 1.5, 0.0, 1.0, 0.0});
  wax.sigma_s = Spectrum(0.5, 1.5, 6.0);
  scene.channels = 3;
  scene.lights = {beam(Vec3::UnitX(), 2.0)};
  scene.objects = {{"body", Sphere{Vec3::Zero(), 1.0}, wax}};
  const PreparedScene p = prepare_scene(scene);
  const Ray ray{Vec3(0, 0, 3), -Vec3::UnitZ()};
  const auto hit = p.caster->nearest(ray);
  Rng rng(6, Stream::tests, 0);
  test::Mean means[3];
  for (int i = 0; i < 20'000; ++i) {
    const Spectrum L =
        once_scattered(p.scene, *p.caster, ray, *hit, hit->normal, rng.uniform(), rng);
    for (int c = 0; c < 3; ++c) means[c].add(L[c]);
  }
  for (int c = 0; c < 3; ++c) {
    const PreparedScene one = one_object(
        Sphere{Vec3::Zero(), 1.0}, {0.2, wax.sigma_s[c], 0.0, 1.0, 0.0}, beam(Vec3::UnitX(), 2.0));
    EXPECT_NEAR(means[c].mean(), look(one, ray, 4000).mean(), 5.0 * means[c].standard_error()) << c;
  }
}

}  // namespace
}  // namespace knotlight
