#include "render/gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// A ball of radius 1 seen along a chord, with a constant solution and nothing outside.
struct Ball {
  Scene scene;
  std::unique_ptr<RayCaster> caster;
  InsideField field;
  double outside = 0.0;

  Ball(const TranslucentMaterial& material, double U_d) {
    scene.objects = {{"ball", Sphere{Vec3::Zero(), 1.0}, material}};
    caster = std::make_unique<RayCaster>(std::vector<const Shape*>{&scene.objects[0].shape});
    const auto geometry = std::make_shared<GridGeometry>(scene.objects[0].shape, 0.1, Workers(1));
    InsideField::Channel channel;
    channel.U_d = GridField(geometry, Eigen::VectorXd::Constant(geometry->finest().dofs, U_d));
    channel.medium = material.medium(0);
    field.channels.push_back(channel);
  }

  // Mean over n samples along the ray at x = offset, and its standard error.
  std::pair<double, double> look(double offset, int n) const {
    const Gather gather(scene, *caster, 0, field, [this](const OutsideRay&, Rng&) {
      return Spectrum(Spectrum::Constant(outside));
    });
    const Ray ray{Vec3(offset, 0, 3), -Vec3::UnitZ()};
    const auto hit = caster->nearest(ray);
    Rng rng(5, Stream::tests, 0);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; ++i) {
      const double L =
          gather.radiance({hit->position, ray.direction}, *hit, 2, (i + 0.5) / n, rng).sum()[0];
      sum += L / n;
      squares += L * L / n;
    }
    return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / n)};
  }
};

TranslucentMaterial material(double sigma_a, double sigma_s) {
  TranslucentMaterial result;
  result.sigma_a = Spectrum::Constant(sigma_a);
  result.sigma_s = Spectrum::Constant(sigma_s);
  return result;
}

// albedo U_d (1 - exp(-sigma_t S)) + E / (4 pi sigma_t) (1 - exp(-sigma_t S)) + exp(-sigma_t S)
// outside, from a grazing chord to the diameter.
TEST(Gather, ConstantFieldEmissionAndBackgroundHaveTheirClosedForm) {
  TranslucentMaterial wax = material(0.4, 0.8);
  wax.emission = Spectrum::Constant(3.0);
  Ball ball(wax, 0.7);
  ball.outside = 0.25;
  for (const double offset : {0.0, 0.6, 0.95, 0.999}) {
    const double S = 2.0 * std::sqrt(1.0 - offset * offset);
    const double passed = std::exp(-1.2 * S);
    const double expected =
        (0.8 / 1.2 * 0.7 + 3.0 / (4.0 * pi * 1.2)) * (1.0 - passed) + 0.25 * passed;
    // The first scatterings of the outside's constant radiance are looked for too; there are none
    // in a scene whose surroundings are dark.
    EXPECT_NEAR(ball.look(offset, 16).first, expected, 1e-9) << offset;
  }
}

// A beam along +x through a ball seen along -z at x = y = 0: at depth s the beam has come sqrt(1 -
// (1-s)^2) through the medium; L = sigma_s p(90 degrees) E int exp(-sigma_t (s + way)) ds, by a sum
// of 20 000 terms. 4000 stratified samples: 1e-4.
TEST(Gather, SingleScatteringHasItsIntegral) {
  TranslucentMaterial milk = material(0.2, 1.5);
  milk.g = Spectrum::Constant(0.6);
  Ball ball(milk, 0.0);
  ball.scene.lights = {DirectionalLight{Vec3::UnitX(), Spectrum::Constant(2.0)}};
  double expected = 0.0;
  constexpr int terms = 20'000;
  for (int i = 0; i < terms; ++i) {
    const double s = 2.0 * (i + 0.5) / terms;
    const double way = std::sqrt(std::max(0.0, 1.0 - (1.0 - s) * (1.0 - s)));
    expected += std::exp(-1.7 * (s + way)) * 2.0 / terms;
  }
  const double phase = (1.0 - 0.36) / (4.0 * pi * std::pow(1.36, 1.5));
  expected *= 1.5 * phase * 2.0;
  EXPECT_NEAR(ball.look(0.0, 4000).first, expected, 2e-4 * expected);
}

// Light scattered twice in a thin ball, epsilon = 1 (Grosjean): the mean over all directions of
// what one flight back collects. At the centre of a ball of optical radius T under a beam, U of
// once scattered light = sigma_s / (4 pi) int exp(-sigma_t r) U_ri(r w) dr dw, by midpoint sums
// over r and the angle to the beam, U_ri = E / (4 pi) exp(-sigma_t (sqrt(1 - rho^2) + z)). 200 000
// flights, five standard errors: a false alarm once in two million.
TEST(Gather, TransientPartIsOneFlight) {
  Ball ball(material(0.1, 1.1), 0.0);
  ball.scene.lights = {DirectionalLight{Vec3::UnitZ(), Spectrum::Constant(5.0)}};
  ball.field.channels[0].beyond_p1 = PointSourceField::grosjean(1.1 / 1.2);
  ball.field.channels[0].k = 0.7104 / 1.2;
  ball.field.surface =
      FeltSurface{SurfaceCurvature(ball.scene.objects[0].shape, 1.0), SurfaceLayer(1.0)};
  const Gather gather(ball.scene, *ball.caster, 0, ball.field,
                      [](const OutsideRay&, Rng&) { return Spectrum(Spectrum::Zero()); });
  double expected = 0.0;
  constexpr int steps = 600;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double r = (i + 0.5) / steps;
      const double mu = 2.0 * (j + 0.5) / steps - 1.0;
      const double z = r * mu;
      const double rho2 = r * r - z * z;
      const double U_ri = 5.0 / (4.0 * pi) * std::exp(-1.2 * (std::sqrt(1.0 - rho2) + z));
      expected += 0.5 * 1.1 * std::exp(-1.2 * r) * U_ri / steps * 2.0 / steps;
    }
  Rng rng(6, Stream::tests, 0);
  constexpr int n = 200'000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double U = gather.transient(Vec3::Zero(), rng)[0];
    sum += U / n;
    squares += U * U / n;
  }
  EXPECT_NEAR(sum, expected, 5.0 * std::sqrt((squares - sum * sum) / n));
}

}  // namespace
}  // namespace knotlight
