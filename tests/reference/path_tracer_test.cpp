#include "reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "reference/legendre.h"
#include "reference/path_scenes.h"

namespace knotlight {
namespace {

using namespace test;
using std::numbers::pi;

// Where nothing absorbs and radiance 1 comes from everywhere, the radiance is 1 everywhere outside,
// whatever scatters, mirrors or refracts: radiance over n^2 is in equilibrium.
struct Furnace {
  const char* name;
  std::vector<Object> objects;
};
std::vector<Furnace> furnaces() {
  const Vec3 half(0.7, 0.6, 0.5);
  const Object tilted = block(medium(0.0, 4.0, 0.3, 1.4), -half, half);
  TranslucentMaterial coloured = medium(0.0, 3.0, 0.0, 1.3);
  coloured.sigma_s = Spectrum(1.0, 4.0, 9.0);
  coloured.g = Spectrum(0.0, 0.5, -0.5);
  TranslucentMaterial frosted = medium(0.0, 3.0, 0.2, 1.4);
  frosted.roughness = 0.5;
  return {
      {"rough", {ball(frosted)}},
      {"matched", {ball(medium(0.0, 10.0, 0.0))}},
      {"forward", {ball(medium(0.0, 10.0, 0.8))}},
      {"backward", {ball(medium(0.0, 5.0, -0.6))}},
      {"refracting", {ball(medium(0.0, 5.0, 0.3, 1.4))}},
      {"block", {tilted}},
      {"matched block", {block(medium(0.0, 4.0, 0.3), -half, half)}},
      {"coloured", {ball(coloured)}},
      // In touch: two refracting balls, a matched block on a white table, a white ball in wax.
      {"touching",
       {ball(medium(0.0, 3.0, 0.0, 1.5), 0.5, Vec3(-0.5, 0, 0)),
        ball(medium(0.0, 3.0, 0.0, 1.3), 0.5, Vec3(0.5, 0, 0))}},
      {"blocks in touch",
       {block(medium(0.0, 3.0, 0.0, 1.4), Vec3(-0.7, -0.7, -0.5), Vec3(0, 0.7, 0.5)),
        block(medium(0.0, 5.0), Vec3(0, -0.7, -0.5), Vec3(0.7, 0.7, 0.5))}},
      {"on a table",
       {block(medium(0.0, 3.0), Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)),
        {"table", quad_mesh(Vec3(0, 0, -0.5), Vec3(1.2, 0, 0), Vec3(0, 1.2, 0)), diffuse(1.0)}}},
      {"white core", {ball(medium(0.0, 3.0, 0.2, 1.4)), ball(diffuse(1.0), 0.4)}},
  };
}

class FurnaceTest : public testing::TestWithParam<std::size_t> {
 protected:
  void check(const std::vector<Light>& lights) const {
    const Furnace furnace = furnaces()[GetParam()];
    const int channels = std::string(furnace.name) == "coloured" ? 3 : 1;
    const Traced traced(lights, furnace.objects, channels);
    constexpr std::size_t samples = 3000;
    for (int channel = 0; channel < channels; ++channel) {
      SCOPED_TRACE(furnace.name);
      expect_mean(traced.mean(samples, over_disc(), channel), 1.0);
    }
  }
};

TEST_P(FurnaceTest, UnderAnEvenSky) {
  check({sky(1.0)});
}

// The same sky, found by next-event estimation too (through refracting surfaces as well).
TEST_P(FurnaceTest, UnderAPicturedSky) {
  check({pictured_sky(1.0)});
}

TEST_P(FurnaceTest, InARoomOfAreaLights) {
  check(bright_room(6.0, 1.0));
}

INSTANTIATE_TEST_SUITE_P(PathTracer, FurnaceTest,
                         testing::Range(std::size_t{0}, furnaces().size()));

// Where a surface mirrors a lot, a wrong Fresnel factor in either way of finding the sky shows.
TEST(PathTracer, BothWaysOfFindingTheSkyThroughAStrongMirror) {
  const Traced traced({pictured_sky(1.0)}, {ball(medium(0.0, 1.0, 0.0, 2.5))});
  expect_mean(traced.mean(30'000, over_disc()), 1.0);
}

// An even sky needs no dice but for the way out: without absorption each sample is exact.
TEST(PathTracer, EachSampleOfAFurnaceIsOne) {
  const Traced traced({sky(1.0)}, {ball(medium(0.0, 10.0, 0.5))});
  for (std::size_t i = 0; i < 200; ++i) {
    Rng rng(1, Stream::tests, i);
    // What passes unscattered, less than exp(-20) to exp(-2) here, is played for.
    EXPECT_NEAR(traced.tracer().radiance({Vec3(0.3, 0.2, 5.0), -Vec3::UnitZ()}, rng)[0], 1.0,
                0.021);
  }
}

// Three independent path tracers agree on 0.8941 +- 0.0005 for the absorbing ball of radius 1 in a
// furnace.
TEST(PathTracer, AbsorbingFurnace) {
  const Traced traced({sky(1.0)}, {ball(medium(0.1, 10.0))});
  expect_mean(traced.mean(60'000, over_disc()), 0.8941, 0.0005);
}

// The ball under a point light: mean over the disc by three independent path tracers.
TEST(PathTracer, BallUnderAPointLight) {
  const Traced traced({PointLight{Vec3(3, 0, 3), grey(18.0)}}, {ball(medium(0.1, 10.0))});
  expect_mean(traced.mean(150'000, over_disc()), 0.1381, 0.0005);
  // Its row |y| < 0.1, averaged over 0.1 in x; known to 4 decimals and, by their noise, to 1 %.
  const std::pair<double, double> row[] = {{-0.9, 0.0027}, {-0.5, 0.0401}, {-0.1, 0.1618},
                                           {0.1, 0.2231},  {0.5, 0.3205},  {0.9, 0.2886}};
  for (const auto& [x, expected] : row) {
    const Mean found = traced.mean(20'000, [x = x](Rng& rng) {
      const double dx = 0.1 * rng.uniform() - 0.05;
      return Ray{Vec3(x + dx, 0.2 * rng.uniform() - 0.1, 5.0), -Vec3::UnitZ()};
    });
    expect_mean(found, expected, 0.00005 + 0.01 * expected);
  }
}

// Chandrasekhar's function by its integral equation, in the form that converges for all albedos:
// 1 / H(mu) = sqrt(1 - albedo) + (albedo / 2) int mu' H(mu') / (mu + mu') dmu' over (0, 1).
double chandrasekhar_h(double mu, double albedo) {
  const Quadrature q = gauss_legendre(64);
  std::vector<double> H(q.nodes.size(), 1.0);
  const auto next = [&](double x) {
    double sum = 0.0;
    for (std::size_t j = 0; j < q.nodes.size(); ++j) {
      const double y = 0.5 * (1.0 + q.nodes[j]);
      sum += 0.5 * q.weights[j] * y * H[j] / (x + y);
    }
    return 1.0 / (std::sqrt(1.0 - albedo) + 0.5 * albedo * sum);
  };
  for (int iteration = 0; iteration < 200; ++iteration) {
    std::vector<double> better;
    for (const double node : q.nodes) better.push_back(next(0.5 * (1.0 + node)));
    H = better;
  }
  return next(mu);
}

// A half-space under a beam of irradiance 1 across itself: [Ch60]
// I(mu) = albedo / (4 pi) mu_0 / (mu + mu_0) H(mu) H(mu_0). Here a block so wide and deep that what
// misses is below 1e-6.
TEST(PathTracer, HalfSpace) {
  for (const double albedo : {0.5, 0.9}) {
    const Object slab = block(medium(1.0 - albedo, albedo), Vec3(-60, -60, -60), Vec3(60, 60, 0));
    const double mu_0 = 0.6;
    const Traced traced({DirectionalLight{Vec3(0.8, 0, -mu_0), grey(1.0)}}, {slab});
    for (const double mu : {0.2, 1.0}) {
      const Vec3 view(0.0, std::sqrt(1.0 - mu * mu), -mu);
      const double exact = albedo / (4.0 * pi) * mu_0 / (mu + mu_0) * chandrasekhar_h(mu, albedo) *
                           chandrasekhar_h(mu_0, albedo);
      expect_mean(traced.mean(30'000, along(-5.0 * view, view)), exact, 1e-6);
    }
  }
}

// A half-space of index n that hardly scatters: light is refracted in, scattered once and refracted
// out. Inside, L = albedo / (4 pi) F mu_0' / (mu' + mu_0') with the beam's irradiance F across
// itself there, F = T cos(theta_0) / cos(theta_0'); outside T / n^2 of that is left.
// What is scattered twice is of the order of the albedo.
TEST(PathTracer, RefractedSingleScattering) {
  const double albedo = 1e-4;
  const double n = 1.4;
  const double mu_0 = 0.6;
  const auto inside = [n](double mu) { return std::sqrt(1.0 - (1.0 - mu * mu) / (n * n)); };
  const double exact_up_to = 3.0 * albedo;
  TranslucentMaterial wax = medium(1.0 - albedo, albedo, 0.4, n);
  const Object slab = block(wax, Vec3(-90, -90, -60), Vec3(90, 90, 0));
  const Vec3 beam(0.8, 0, -mu_0);
  for (const double mu : {0.3, 1.0}) {
    const Vec3 view(0.0, std::sqrt(1.0 - mu * mu), -mu);
    const double F = (1.0 - fresnel_reflectance(mu_0, n)) * mu_0 / inside(mu_0);
    const Vec3 travelling = *refract(beam, Vec3::UnitZ(), n);
    const Vec3 leaving = -*refract(view, Vec3::UnitZ(), n);
    const double cosine = travelling.dot(leaving);
    const double phase = (1.0 - 0.16) / (4.0 * pi * std::pow(1.16 - 0.8 * cosine, 1.5));
    const double exact = albedo * phase * F * inside(mu_0) / (inside(mu) + inside(mu_0)) *
                         (1.0 - fresnel_reflectance(mu, n)) / (n * n);
    const Traced far({DirectionalLight{beam, grey(1.0)}}, {slab});
    expect_mean(far.mean(40'000, along(-5.0 * view, view)), exact, exact_up_to * exact);
    // A distant point light is nearly a beam: 1e4 away, the angle changes by 1e-4 over one mean
    // free path.
    const double distance = 1e4;
    const Traced near({PointLight{-distance * beam, grey(distance * distance)}}, {slab});
    expect_mean(near.mean(40'000, along(-5.0 * view, view)), exact, 5e-4 * exact);
  }
}

// The same under a lamp at the height h. Light that leaves it at the angle i from the normal is at
// the distance x(i) = h tan(i) + d tan(t) from below it at the depth d, sin(i) = n sin(t). Between
// i and i + di it has the solid angle 2 pi sin(i) di and, across itself, the area 2 pi x cos(t) dx,
// so that its irradiance is T I sin(i) / (x cos(t) dx/di). Seen straight from above at the distance
// `aside` from the lamp's foot, the integral along depth is summed by the midpoint rule.
TEST(PathTracer, RefractedSingleScatteringOfANearLamp) {
  const double albedo = 1e-4;
  const double n = 1.45;
  const double h = 0.7;
  const double aside = 1.1;
  const double g = 0.4;
  const auto inner = [n](double i) { return std::asin(std::sin(i) / n); };
  constexpr int steps = 4000;
  const double deepest = 30.0;  // of which exp(-30) comes back
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double d = deepest * std::pow((k + 0.5) / steps, 2);
    const double dd = deepest * (2.0 * k + 1.0) / (static_cast<double>(steps) * steps);
    double lo = 0.0;
    double hi = std::atan(aside / h);
    for (int half = 0; half < 60; ++half) {
      const double i = 0.5 * (lo + hi);
      (h * std::tan(i) + d * std::tan(inner(i)) < aside ? lo : hi) = i;
    }
    const double t = inner(lo);
    const double dt = std::cos(lo) / (n * std::cos(t));
    const double dx = h / std::pow(std::cos(lo), 2) + d * dt / std::pow(std::cos(t), 2);
    const double irradiance = (1.0 - fresnel_reflectance(std::cos(lo), n)) * std::sin(lo) /
                              (aside * std::cos(t) * dx) * std::exp(-d / std::cos(t));
    const double phase =
        (1.0 - g * g) / (4.0 * pi * std::pow(1.0 + g * g + 2.0 * g * std::cos(t), 1.5));
    sum += albedo * phase * irradiance * std::exp(-d) * dd;
  }
  const double exact = sum * (1.0 - fresnel_reflectance(1.0, n)) / (n * n);
  const Traced traced(
      {PointLight{Vec3(0, 0, h), grey(1.0)}},
      {block(medium(1.0 - albedo, albedo, g, n), Vec3(-40, -40, -40), Vec3(40, 40, 0))});
  expect_mean(traced.mean(40'000, along(Vec3(aside, 0, 5), -Vec3::UnitZ())), exact,
              3.0 * albedo * exact);
}

// A small area light is a point light of intensity radiance times area; the ball is so dense that
// light mirrored inside before it is scattered, which the point light lacks, is below exp(-14).
TEST(PathTracer, SmallAreaLightIsAPointLightThroughRefraction) {
  const Object wax = ball(medium(0.5, 10.0, 0.0, 1.4));
  const double half = 0.05;
  const AreaLight square{Vec3(0, 0, 4), Vec3(half, 0, 0), Vec3(0, -half, 0), grey(1e4)};
  const PointLight point{Vec3(0, 0, 4), square.radiance * square.area()};
  const auto eye = [](Rng& rng) {
    const double u = rng.uniform();
    const Eigen::Vector2d p = sample_disc(u, rng.uniform());
    return Ray{Vec3(p.x(), -5.0, p.y()), Vec3::UnitY()};
  };
  const Mean by_area = Traced({square}, {wax}).mean(20'000, eye);
  const Mean by_point = Traced({point}, {wax}).mean(20'000, eye);
  // Finite size: half^2 / distance^2 = 3e-4 of the light, and the other way round the rim.
  const double error = std::hypot(by_area.standard_error(), by_point.standard_error());
  EXPECT_NEAR(by_area.mean(), by_point.mean(), z_one_in_a_million * error + 1e-3 * by_point.mean());
}

// A facetted ball is not a round one, but with 5000 facets its lights differ by less than a
// percent.
TEST(PathTracer, MeshAndSphereRefractAlike) {
  const PointLight lamp{Vec3(3, 0, 3), grey(18.0)};
  TriangleMesh sphere = refine(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1)), 0.08);
  for (Vec3& v : sphere.vertices) v.normalize();
  const TranslucentMaterial wax = medium(0.5, 5.0, 0.0, 1.4);
  const Mean round = Traced({lamp}, {ball(wax)}).mean(6000, over_disc());
  const Mean flat = Traced({lamp}, {{"mesh", sphere, wax}}).mean(6000, over_disc());
  const double error = std::hypot(round.standard_error(), flat.standard_error());
  EXPECT_NEAR(flat.mean(), round.mean(), z_one_in_a_million * error + 0.01 * round.mean());
}

// Lambert: reflectance / pi times the irradiance.
TEST(PathTracer, DiffusePlane) {
  const Object table{"table", quad_mesh(Vec3::Zero(), Vec3(50, 0, 0), Vec3(0, 50, 0)),
                     diffuse(0.6)};
  const Vec3 place(0.3, 0.2, 0.0);
  const auto eye = along(place + Vec3(0, -1, 1), Vec3(0, 1, -1));
  const Vec3 lamp(1, 2, 3);
  const double distance = (lamp - place).norm();
  expect_mean(Traced({PointLight{lamp, grey(5.0)}}, {table}).mean(10, eye),
              0.6 / pi * 5.0 * 3.0 / std::pow(distance, 3));
  expect_mean(Traced({DirectionalLight{Vec3(0.6, 0, -0.8), grey(2.0)}}, {table}).mean(10, eye),
              0.6 / pi * 2.0 * 0.8);
  expect_mean(Traced({sky(2.0)}, {table}).mean(1000, eye), 0.6 * 2.0);
  expect_mean(Traced({pictured_sky(2.0)}, {table}).mean(20'000, eye), 0.6 * 2.0);
  // Above one corner of a parallel rectangle a x b at height h, [BW99 ch. 4.8] and any handbook:
  // irradiance = radiance / 2 (A atan(B / ...)...), here four times that of a quarter.
  const double h = 2.0;
  const double a = 1.0 / h;
  const double quarter = 0.5 * (a / std::sqrt(1 + a * a) * std::atan(a / std::sqrt(1 + a * a))) * 2;
  const AreaLight square{place + Vec3(0, 0, h), Vec3(1, 0, 0), Vec3(0, -1, 0), grey(3.0)};
  expect_mean(
      Traced({square}, {table}).mean(20'000, along(place + Vec3(0, -3, 0.3), Vec3(0, 3, -0.3))),
      0.6 / pi * 3.0 * 4.0 * quarter);
}

// Two white parallel walls and a beam between them in steps: each reflects all it gets, so that the
// light goes on until it leaves; the radiance is that of a furnace.
TEST(PathTracer, WhiteWallsInAFurnace) {
  const Traced traced(
      {sky(1.0)}, {{"floor", quad_mesh(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 2, 0)), diffuse(1.0)},
                   {"wall", quad_mesh(Vec3(0, 1, 1), Vec3(2, 0, 0), Vec3(0, 0, 1)), diffuse(1.0)}});
  expect_mean(traced.mean(2000, along(Vec3(0, -1, 1), Vec3(0, 1, -1))), 1.0);
}

// Through two balls that absorb, one in the other's shadow, in touch or apart: what reaches the
// table is weakened by both chords.
TEST(PathTracer, IndexMatchedBallsShadeEachOther) {
  const TranslucentMaterial glass = medium(1.0, 0.0);
  const Object table{"table", quad_mesh(Vec3(0, 0, -3), Vec3(5, 0, 0), Vec3(0, 5, 0)),
                     diffuse(1.0)};
  for (const double gap : {0.0, 0.2}) {
    const Traced traced(
        {DirectionalLight{-Vec3::UnitZ(), grey(1.0)}},
        {ball(glass, 0.5, Vec3(0, 0, 0.5 + gap)), ball(glass, 0.6, Vec3(0, 0, -0.6)), table});
    const double x = 0.3;
    const double chords = 2.0 * (std::sqrt(0.25 - x * x) + std::sqrt(0.36 - x * x));
    // From the side: the eye sees the table past the balls.
    expect_mean(traced.mean(10, along(Vec3(x, -4, -2.9), Vec3(0, 4, -0.1))),
                std::exp(-chords) / pi);
    // And from above through both: once more the same.
    expect_mean(traced.mean(4000, along(Vec3(x, 0, 4), -Vec3::UnitZ())),
                std::exp(-2.0 * chords) / pi);
  }
}

// Without scattering, E / (4 pi) (1 - exp(-sigma_a l)) / sigma_a comes out of a chord l.
TEST(PathTracer, EmissionOfAThinBall) {
  const double sigma_a = 0.3;
  const Traced traced({}, {ball(medium(sigma_a, 0.0, 0.0, 1.0, 2.0))});
  const double x = 0.6;
  const double chord = 2.0 * std::sqrt(1.0 - x * x);
  expect_mean(traced.mean(10, along(Vec3(x, 0, 5), -Vec3::UnitZ())),
              2.0 / (4.0 * pi) * (1.0 - std::exp(-sigma_a * chord)) / sigma_a);
}

// Without absorption all that is emitted gets out, E (4 / 3) pi R^3; the flux through all discs pi
// R^2 is 4 pi times the mean radiance over the disc: that is E R / (3 pi). Per channel.
TEST(PathTracer, EmissionOfAScatteringBall) {
  TranslucentMaterial wax = medium(0.0, 3.0, 0.4);
  wax.sigma_s = Spectrum(0.5, 3.0, 6.0);
  wax.g = Spectrum(0.0, 0.4, 0.8);
  wax.emission = Spectrum(1.0, 2.0, 3.0);
  const Traced traced({}, {ball(wax)}, 3);
  for (int c = 0; c < 3; ++c)
    expect_mean(traced.mean(20'000, over_disc(), c), wax.emission[c] / (3.0 * pi));
}

// A lamp in the middle of a ball without absorption: all its light gets out, 4 pi I, but for what
// is never scattered, exp(-sigma_s R), which the eye does not see. Mean over the disc as above: I /
// (pi R^2). The estimate has a long tail (its variance grows as the logarithm of the number of
// samples), so that its standard error is a little low; 0.5 % more is allowed for. With refraction
// the ball is so dense that what is mirrored before it is scattered, and not found, is below that.
TEST(PathTracer, LampInsideABall) {
  struct Case {
    double sigma_s, ior;
    std::size_t samples;
  };
  for (const auto& [sigma_s, ior, samples] : {Case{1.5, 1.0, 200'000}, Case{8.0, 1.4, 60'000}}) {
    const Traced traced({PointLight{Vec3::Zero(), grey(2.0)}},
                        {ball(medium(0.0, sigma_s, 0.2, ior))});
    const double expected = 2.0 / pi * (1.0 - std::exp(-sigma_s));
    expect_mean(traced.mean(samples, over_disc()), expected, 0.005 * expected);
  }
}

// A clear plate of index n that absorbs, in a furnace: of what goes in, R is mirrored at each side
// and a = exp(-sigma_a l) left of each crossing: R + T^2 a / (1 - R a).
TEST(PathTracer, ClearPlate) {
  const double sigma_a = 0.5;
  const double n = 1.5;
  const Traced traced({sky(1.0)},
                      {block(medium(sigma_a, 0.0, 0.0, n), Vec3(-90, -90, -1), Vec3(90, 90, 0))});
  for (const double mu : {0.4, 1.0}) {
    const double mu_inside = std::sqrt(1.0 - (1.0 - mu * mu) / (n * n));
    const double a = std::exp(-sigma_a / mu_inside);
    const double R = fresnel_reflectance(mu, n);
    const Vec3 view(0.0, std::sqrt(1.0 - mu * mu), -mu);
    expect_mean(traced.mean(4000, along(-5.0 * view, view)),
                R + (1.0 - R) * (1.0 - R) * a / (1.0 - R * a));
  }
}

// The eye sees an area light as a body: its radiance in front, black from behind, also through an
// absorbing medium; light passes it.
TEST(PathTracer, AreaLightSeen) {
  const AreaLight square{Vec3(0, 0, -2), Vec3(1, 0, 0), Vec3(0, 1, 0), grey(3.0)};
  const Object glass = ball(medium(0.7, 0.0));
  const Object table{"table", quad_mesh(Vec3(0, 0, -3), Vec3(9, 0, 0), Vec3(0, 9, 0)),
                     diffuse(1.0)};
  const auto down = along(Vec3(0, 0, 5), -Vec3::UnitZ());
  const auto up = along(Vec3(0.2, 0, -2.5), Vec3::UnitZ());
  expect_mean(Traced({square}, {glass}).mean(1000, down), 3.0 * std::exp(-1.4));
  const Traced lit({square, DirectionalLight{-Vec3::UnitZ(), grey(1.0)}}, {table});
  expect_mean(lit.mean(10, down), 3.0);
  expect_mean(lit.mean(10, up), 0.0);
  expect_mean(lit.mean(10, along(Vec3(2, 0, -2.5), Vec3(-2, 0, -0.5))), 1.0 / pi);
}

// What three channels find together is what each would find alone.
TEST(PathTracer, ChannelsTogetherAndAlone) {
  TranslucentMaterial wax = medium(0.0, 0.0);
  wax.sigma_a = Spectrum(0.1, 0.2, 0.5);
  wax.sigma_s = Spectrum(6.0, 3.0, 1.0);
  wax.g = Spectrum(0.0, 0.5, 0.8);
  const std::vector<Light> lights = {
      PointLight{Vec3(3, 0, 3), grey(18.0)},
      AreaLight{Vec3(-3, 0, 1), Vec3(0, 1, 0), Vec3(0, 0, 1), grey(2.0)}};
  const Traced together(lights, {ball(wax)}, 3);
  for (int c = 0; c < 3; ++c) {
    const Medium m = wax.medium(c);
    const Traced alone(lights, {ball(medium(m.sigma_a, m.sigma_s, m.g))});
    const Mean a = together.mean(10'000, over_disc(), c);
    const Mean b = alone.mean(10'000, over_disc());
    EXPECT_NEAR(a.mean(), b.mean(),
                z_one_in_a_million * std::hypot(a.standard_error(), b.standard_error()));
  }
}

}  // namespace
}  // namespace knotlight
