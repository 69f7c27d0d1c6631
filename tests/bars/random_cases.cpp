#include "random_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/rng.h"
#include "core/sampling.h"
#include "reference/ball_p1.h"
#include "reference/sphere_beam_p1.h"

namespace knotlight {
namespace {

constexpr std::array<double, 4> tolerances = {0.005, 0.01, 0.02, 0.04};
constexpr std::array<const char*, 6> shaped = {"torus", "box-16-0.95", "box-40-0.999",
                                               "bunny", "knot",        "bumpy"};
constexpr std::size_t balls_per_shape = 3;
constexpr std::size_t surface_points = 1200;
constexpr double glowing_share = 1.0 / 3.0;

struct Beam {
  Vec3 direction;  // of travel
  double irradiance;
};

struct RandomBall {
  Medium medium;
  Boundary boundary;
  double radius;
  std::vector<Beam> beams;
};

double between(double low, double high, Rng& rng) {
  return low + (high - low) * rng.uniform();
}

double log_between(double low, double high, Rng& rng) {
  return low * std::pow(high / low, rng.uniform());
}

template <class List>
auto one_of(const List& list, Rng& rng) {
  return list[static_cast<std::size_t>(rng.uniform() * static_cast<double>(std::size(list)))];
}

RandomBall random_ball(Rng& rng) {
  RandomBall ball;
  ball.radius = log_between(0.1, 10.0, rng);
  const double sigma_tr = log_between(2.0, 60.0, rng) / ball.radius;
  const double reduced_albedo = 1.0 - log_between(1e-4, 0.5, rng);
  const double g = between(-0.3, 0.9, rng);
  ball.boundary = rng.uniform() < 0.5 ? Boundary::marshak : Boundary::milne;
  ball.beams.resize(1 + static_cast<std::size_t>(3.0 * rng.uniform()));
  double irradiance = 0.0;
  for (Beam& beam : ball.beams) {
    const double u = rng.uniform();
    beam.direction = sample_sphere(u, rng.uniform());
    beam.irradiance = between(0.1, 1.0, rng);
    irradiance += beam.irradiance;
  }
  // In units of the power of the beams, which meet pi R^2 of 4/3 pi R^3.
  const double glow = log_between(0.1, 3.0, rng);
  const double emission =
      rng.uniform() < glowing_share ? glow * 0.75 * irradiance / ball.radius : 0.0;
  ball.medium = Medium{(1.0 - reduced_albedo) * sigma_tr, reduced_albedo * sigma_tr / (1.0 - g), g,
                       1.0, emission};
  return ball;
}

Reference exact(const RandomBall& ball) {
  const SphereBeamP1 beam(ball.medium, ball.boundary, ball.radius);
  const GlowingBallP1 glow(ball.medium, ball.boundary, ball.radius);
  const auto points = stratified_surface_points(Sphere{Vec3::Zero(), ball.radius}, surface_points,
                                                true, 1, Stream::check_points);
  Reference reference;
  const auto n = static_cast<Eigen::Index>(points.size());
  reference.positions.resize(3, n);
  reference.U_d.setConstant(n, ball.medium.emission > 0.0 ? glow.U_d(ball.radius) : 0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3& x = points[static_cast<std::size_t>(i)].position;
    reference.positions.col(i) = x;
    for (const Beam& b : ball.beams) {  // turned so that it travels along -z
      const double z = -b.direction.dot(x);
      const double across = std::sqrt(std::max(0.0, x.squaredNorm() - z * z));
      reference.U_d[i] += b.irradiance * beam.U_d(Vec3(across, 0.0, z));
    }
  }
  return reference;
}

RandomCase case_of(const RandomBall& ball) {
  const Medium& m = ball.medium;
  const std::string boundary = ball.boundary == Boundary::marshak ? "marshak" : "milne";
  std::string lights;
  for (const Beam& b : ball.beams)
    lights += fmt::format("{}{{type: directional, direction: [{}, {}, {}], irradiance: {}}}",
                          lights.empty() ? "" : ", ", b.direction.x(), b.direction.y(),
                          b.direction.z(), b.irradiance);
  RandomCase result;
  result.scene = {"ball",
                  "sphere.yaml",
                  {fmt::format("materials.medium.sigma_a={}", m.sigma_a),
                   fmt::format("materials.medium.sigma_s={}", m.sigma_s),
                   fmt::format("materials.medium.g={}", m.g),
                   fmt::format("materials.medium.emission={}", m.emission),
                   fmt::format("objects.sphere.sphere.radius={}", ball.radius),
                   fmt::format("camera.from=[0, {}, 0]", -5.0 * ball.radius),
                   fmt::format("lights=[{}]", lights), "solver.boundary=" + boundary},
                  {},
                  [ball] { return exact(ball); },
                  0.0};
  result.description = fmt::format(
      "{:.3g} transport mean free paths, reduced albedo {:.4g}, g {:.2g}, {} beams{}, {}",
      ball.radius * m.sigma_tr(), m.reduced_albedo(), m.g, ball.beams.size(),
      m.emission > 0.0 ? " and glow" : "", boundary);
  return result;
}

RandomCase case_of(const std::string& name) {
  const std::vector<BarsCase> cases = bars_cases();
  RandomCase result;
  result.scene =
      *std::find_if(cases.begin(), cases.end(), [&](const BarsCase& c) { return c.name == name; });
  return result;
}

}  // namespace

RandomCase random_case(std::uint64_t seed, std::size_t index) {
  constexpr std::size_t turn = balls_per_shape + 1;
  Rng rng(seed, Stream::tests, index);
  RandomCase result = index % turn < balls_per_shape
                          ? case_of(random_ball(rng))
                          : case_of(shaped[index / turn % std::size(shaped)]);
  const double tolerance = one_of(tolerances, rng);
  result.scene.bar = tolerance;
  result.scene.overrides.push_back(fmt::format("solver.tolerance={}", tolerance));
  result.seed = rng.next_u32();
  return result;
}

}  // namespace knotlight
