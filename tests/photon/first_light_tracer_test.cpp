#include "photon/first_light_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "photon_scenes.h"

namespace knotlight {
namespace {

using namespace testing_scenes;
using std::numbers::pi;

FirstLight first_light(const Scene& scene, const FirstLightOptions& options, int threads = 2) {
  const auto caster = caster_of(scene);
  Stages stages(false);
  Stage stage(stages, "photons", options.rays);
  return trace_first_light(scene, *caster, 0, options, Workers(threads), stage);
}

double power(const std::vector<VolumePhoton>& photons) {
  double sum = 0.0;
  for (const VolumePhoton& p : photons) sum += p.power;
  return sum;
}

FirstLightOptions rays(std::size_t count) {
  FirstLightOptions options;
  options.rays = count;
  return options;
}

// A beam of irradiance 1 on a ball of optical diameter x: pi R^2 (1 - 2/x^2 (1 - (1+x) e^-x)). All
// rays of the beam hit the ball, and a smooth function of where is summed: 1e-5 with 50 000 rays,
// where random ones with their collisions would leave 3e-3.
TEST(FirstLight, BallUnderABeam) {
  const double x = 3.0;
  const Scene scene =
      scene_of({parallel_light(Vec3(1, 2, -2), 1.0)},
               {translucent(Sphere{Vec3(3, 0, 1), 1.0}, {0.5, 1.0, 0.0, 1.0, 0.0})});
  const double exact = pi * (1.0 - 2.0 / (x * x) * (1.0 - (1.0 + x) * std::exp(-x)));
  for (const int m : {1, 4})
    for (const auto depths :
         {FirstLightOptions::Depths::stratified, FirstLightOptions::Depths::gauss}) {
      FirstLightOptions options = rays(50'000);
      options.points_per_ray = m;
      options.depths = depths;
      EXPECT_NEAR(power(first_light(scene, options).photons[0]) / exact, 1.0, 1e-4) << m;
    }
}

// A plate of optical thickness tau and index n at right angles: of the light that gets in, 1 - R,
// the part 1 - e^-tau interacts on each crossing and R of the rest is thrown back:
// (1 - R)(1 - e^-tau) / (1 - R e^-tau). The beam's edge falls on the plate, so the share of rays
// that meet it errs by about 1e-3 with 200 000.
TEST(FirstLight, PlateWithInternalReflections) {
  const double n = 1.8, tau = 0.4;
  const Scene scene =
      scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
               {translucent(box_mesh(Vec3(-1, -1, 0), Vec3(1, 1, 1)), {0.1, 0.3, 0.0, n, 0.0})});
  const double R = std::pow((n - 1.0) / (n + 1.0), 2);
  const double exact = 4.0 * (1.0 - R) * -std::expm1(-tau) / (1.0 - R * std::exp(-tau));
  EXPECT_NEAR(power(first_light(scene, rays(200'000)).photons[0]) / exact, 1.0, 3e-3);
}

// Two boxes in a row, index-matched: the second gets what the first lets through unscattered.
TEST(FirstLight, ThroughOneObjectIntoAnother) {
  const Scene scene =
      scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
               {translucent(box_mesh(Vec3(-1, -1, 1), Vec3(1, 1, 2)), {0.2, 0.5, 0.0, 1.0, 0.0}),
                translucent(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 0)), {0.3, 1.0, 0.0, 1.0, 0.0})});
  const FirstLight light = first_light(scene, rays(200'000));
  EXPECT_NEAR(power(light.photons[0]), 4.0 * -std::expm1(-0.7), 0.01);
  EXPECT_NEAR(power(light.photons[1]), 4.0 * std::exp(-0.7) * -std::expm1(-1.3), 0.005);
}

// A lamp of 2 W/sr at the centre of a ball, index 1.5: along every ray 1 - e^-tau interacts before
// the surface; what is thrown back there crosses the diameter, over and over:
// 8 pi [(1 - e^-tau) + e^-tau R (1 - e^-2tau) / (1 - R e^-2tau)].
TEST(FirstLight, LampInsideABall) {
  Scene scene = scene_of({}, {translucent(Sphere{Vec3::Zero(), 1.0}, {0.1, 0.6, 0.0, 1.5, 0.0})});
  scene.lights = {PointLight{Vec3::Zero(), Spectrum::Constant(2.0)}};
  const double tau = 0.7;
  const double R = fresnel_reflectance(1.0, 1.0 / 1.5);
  const double exact = 8.0 * pi *
                       (-std::expm1(-tau) +
                        std::exp(-tau) * R * -std::expm1(-2 * tau) / (1 - R * std::exp(-2 * tau)));
  EXPECT_NEAR(power(first_light(scene, rays(20'000)).photons[0]) / exact, 1.0, 1e-3);
}

// An opaque ball inside takes what reaches it: 20 mean free paths deep, half of the first-light
// power behind its front half is missing exactly where it casts its shadow.
TEST(FirstLight, OpaqueInclusionsCastShadows) {
  const Scene scene = scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                               {translucent(Sphere{Vec3::Zero(), 1.0}, {0.1, 0.4, 0.0, 1.0, 0.0}),
                                diffuse(Sphere{Vec3::Zero(), 0.5})});
  const FirstLight light = first_light(scene, rays(20'000));
  for (const VolumePhoton& p : light.photons[0]) {
    const bool behind = p.position.z() < 0.0 && p.position.head<2>().norm() < 0.4999;
    EXPECT_FALSE(behind);
  }
}

// Concave, refracting, lit by a sky: the same light as random walks up to their first interaction
// deliver. Power, its first moments and mean squared radius in 400 000 random photons, each within
// 5 standard errors from 64 batches (a false alarm in 500 000 checks); the low-discrepancy error is
// far smaller.
void expect_agreement_with_walks(double roughness) {
  const Medium medium{0.5, 3.5, 0.0, 1.4, 0.0};
  Scene scene = scene_of({sky(1.0), parallel_light(Vec3(1, 0, -1), 2.0)},
                         {translucent(torus_mesh(32, 16), medium)});
  std::get<TranslucentMaterial>(scene.objects[0].material).roughness = roughness;
  const auto moments = [](const VolumePhoton& p) {
    return Eigen::Vector4d(p.power, p.power * p.position.x(), p.power * p.position.z(),
                           p.power * p.position.squaredNorm());
  };
  Eigen::Vector4d expected = Eigen::Vector4d::Zero();
  const FirstLight light = first_light(scene, rays(400'000));
  for (const VolumePhoton& p : light.photons[0]) expected += moments(p);

  constexpr std::size_t batches = 64, per_batch = 6250;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero(), squares = Eigen::Vector4d::Zero();
  for (std::size_t b = 0; b < batches; ++b) {
    Eigen::Vector4d batch = Eigen::Vector4d::Zero();
    const TraceResult walks =
        trace(scene, TracerOptions::Orders::first, per_batch, true, 2, 100 + b);
    for (const VolumePhoton& p : walks.photons[0]) batch += moments(p);
    sum += batch;
    squares += batch.cwiseAbs2();
  }
  const Eigen::Vector4d mean = sum / batches;
  const Eigen::Vector4d error =
      ((squares / batches - mean.cwiseAbs2()) / (batches - 1.0)).cwiseSqrt();
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(expected[i], mean[i], sigmas * error[i]) << i;
}

TEST(FirstLight, AgreesWithRandomWalks) {
  expect_agreement_with_walks(0.0);
  expect_agreement_with_walks(0.6);
}

// rms error over 8 replicates of the centroid's depth under a beam, which is smooth in everything:
// 2000 against 64 000 rays, a factor of 5.7 for random ones. At least 14 (n^-0.77) is asked.
TEST(FirstLight, ConvergesFasterThanRandom) {
  const Scene scene = scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                               {translucent(Sphere{Vec3::Zero(), 1.0}, {0.5, 4.5, 0.0, 1.0, 0.0})});
  const auto moment = [&](std::size_t count, std::uint64_t replicate) {
    FirstLightOptions options = rays(count);
    options.replicate = replicate;
    double sum = 0.0;
    const FirstLight light = first_light(scene, options);
    for (const VolumePhoton& p : light.photons[0]) sum += p.power * p.position.z();
    return sum;
  };
  const double exact = moment(2'000'000, 99);
  double few = 0.0, many = 0.0;
  for (std::uint64_t r = 0; r < 8; ++r) {
    few += std::pow(moment(2000, r) - exact, 2);
    many += std::pow(moment(64'000, r) - exact, 2);
  }
  EXPECT_LT(std::sqrt(many), std::sqrt(few) / 14.0);
}

TEST(FirstLight, SameBitsForAnyNumberOfThreads) {
  const Scene scene = scene_of({sky(1.0), parallel_light(-Vec3::UnitZ(), 1.0)},
                               {translucent(torus_mesh(32, 16), {0.5, 3.5, 0.0, 1.4, 0.0})});
  const FirstLight one = first_light(scene, rays(20'000), 1);
  const FirstLight three = first_light(scene, rays(20'000), 3);
  ASSERT_EQ(one.photons[0].size(), three.photons[0].size());
  EXPECT_EQ(one.emitted, three.emitted);
  for (std::size_t i = 0; i < one.photons[0].size(); ++i)
    ASSERT_EQ(one.photons[0][i].position, three.photons[0][i].position);
}

}  // namespace
}  // namespace knotlight
