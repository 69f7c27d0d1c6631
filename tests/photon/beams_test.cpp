// Beams among directions, and the mass of a kernel under a beam against closed forms.
#include "photon/beams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

using std::numbers::pi;

TEST(Beams, AreToldFromTheSky) {
  Rng rng(2, Stream::tests, 0);
  std::vector<Vec3> directions;
  std::vector<Vec3> offsets;
  for (int i = 0; i < 600; ++i) {
    const double u = rng.uniform();
    const Vec3 any = sample_sphere(u, rng.uniform());
    offsets.push_back(0.1 * any);
    directions.push_back(i % 3 == 0   ? Vec3(Vec3::UnitZ())
                         : i % 3 == 1 ? Vec3(-Vec3::UnitX())
                                      : any);
  }
  const Beams found = find_beams(directions, offsets);
  ASSERT_EQ(found.beams.size(), 2U);
  EXPECT_GE(found.beams[0].members.size(), 200U);
  EXPECT_LE(found.beams[0].members.size(), 205U);
  EXPECT_EQ(found.beams[0].members.size() + found.beams[1].members.size() + found.others.size(),
            600U);
}

// Rays from a point at distance 4: the spread is 1/4, the direction that at the centre of the ball,
// though the photons lie to one side of it.
TEST(Beams, SpreadOfAPointLight) {
  Rng rng(3, Stream::tests, 0);
  const Vec3 lamp(0, 0, 4);
  std::vector<Vec3> directions;
  std::vector<Vec3> offsets;
  for (int i = 0; i < 500; ++i) {
    const double u = rng.uniform();
    Vec3 p = 0.2 * sample_sphere(u, rng.uniform());
    p.x() = std::abs(p.x());
    offsets.push_back(p);
    directions.push_back((p - lamp).normalized());
  }
  const Beams found = find_beams(directions, offsets);
  ASSERT_EQ(found.beams.size(), 1U);
  // To second order in 0.2/4.
  EXPECT_NEAR(found.beams[0].spread, 0.25, 0.01);
  EXPECT_LT((found.beams[0].direction + Vec3::UnitZ()).norm(), 1e-3);
}

class BeamMass : public ::testing::Test {
 protected:
  Shape box_ = box_mesh(Vec3(-3, -3, -3), Vec3(3, 3, 0));
  Shape sphere_ = Sphere{Vec3(0, 0, 20), 1.0};
  RayCaster caster_{{&box_, &sphere_}};
  static constexpr double sigma_t = 2.0;

  double mass(const Vec3& x, const Vec3& w, double r, std::uint32_t object,
              double spread = 0.0) const {
    return beam_mass(x, {w, spread, {}}, r, RadialKernel::ball, sigma_t, true, caster_, object);
  }
};

// Deep under a plane, with rho = sigma_t r / cos: the mean of exp(rho' u) over the ball, for the
// gradient of the path n/cos.  3 (rho cosh rho - sinh rho)/rho^3 times the volume.
TEST_F(BeamMass, InsideASlabUnderSlantedLight) {
  const double r = 0.4;
  for (const double cosine : {1.0, 0.8, 0.5}) {
    const Vec3 w(std::sqrt(1.0 - cosine * cosine), 0, -cosine);
    const double rho = sigma_t * r / cosine;
    const double exact =
        4.0 * pi * r * r * r * (rho * std::cosh(rho) - std::sinh(rho)) / (rho * rho * rho);
    EXPECT_NEAR(mass(Vec3(0.2, 0.1, -0.5), w, r, 0) / exact, 1.0, 2e-3) << cosine;
  }
}

// On the surface, normal incidence: int over the half ball of exp(-sigma_t z),
//   pi r^2 / sigma_t (...), written with rho = sigma_t r as in photon_map_test.cpp.
TEST_F(BeamMass, OnALitFace) {
  const double r = 0.4;
  const double rho = sigma_t * r;
  const double exact =
      2.0 / 3.0 * pi * r * r * r * 1.5 *
      (1.0 / rho - 2.0 / std::pow(rho, 3) + 2.0 * (1.0 + rho) * std::exp(-rho) / std::pow(rho, 3));
  EXPECT_NEAR(mass(Vec3(0.2, 0.1, 0), -Vec3::UnitZ(), r, 0) / exact, 1.0, 3e-3);
}

// Brute force: random points of the ball, each with its own way to the light. 4e5 points: relative
// standard error below 0.25 %; five of them and 1 % for the lines where a shadow's edge crosses the
// ball.
TEST_F(BeamMass, AgreesWithRandomPoints) {
  constexpr int n = 400'000;
  const double r = 0.3;
  const Vec3 w(0, 0.6, -0.8);
  const Vec3 lamp = Vec3(0, 0, 20) - 3.0 * w;
  for (const Vec3& direction : {Vec3(0, 0, -1), Vec3(0, 0.8, 0.6), Vec3(0.6, 0, 0.8)}) {
    for (const bool point : {false, true}) {
      const Vec3 x = Vec3(0, 0, 20) + 0.97 * direction;
      const auto light = [&](const Vec3& y) {
        const double distance = (y - lamp).norm();
        const Vec3 d = point ? Vec3((y - lamp) / distance) : w;
        const double b = (y - Vec3(0, 0, 20)).dot(d);
        const double s = b + std::sqrt(b * b + 1.0 - (y - Vec3(0, 0, 20)).squaredNorm());
        return std::exp(-sigma_t * s) / (point ? distance * distance : 1.0);
      };
      double sum = 0.0;
      for (int i = 0; i < n; ++i) {
        Rng rng(4, Stream::tests, static_cast<std::uint64_t>(i));
        const double radius = r * std::cbrt(rng.uniform());
        const double u = rng.uniform();
        const Vec3 y = x + radius * sample_sphere(u, rng.uniform());
        if ((y - Vec3(0, 0, 20)).norm() < 1.0) sum += light(y) / light(x);
      }
      const double exact = 4.0 / 3.0 * pi * r * r * r * sum / n;
      const Vec3 axis = point ? Vec3((x - lamp).normalized()) : w;
      EXPECT_NEAR(mass(x, axis, r, 1, point ? 1.0 / (x - lamp).norm() : 0.0) / exact, 1.0, 0.0225)
          << direction.transpose() << point;
    }
  }
}

}  // namespace
}  // namespace knotlight
