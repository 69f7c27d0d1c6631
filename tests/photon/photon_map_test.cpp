// Density estimates against a sum over all photons, and against closed forms of the reduced
// incident light.
#include "photon/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "photon/ball_volume.h"
#include "photon/photon_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::caster_of;
using testing_scenes::parallel_light;
using testing_scenes::scene_of;
using testing_scenes::sigmas;
using testing_scenes::sky;
using testing_scenes::trace;
using testing_scenes::translucent;
using Orders = TracerOptions::Orders;

std::vector<VolumePhoton> random_photons(std::size_t n) {
  Rng rng(3, Stream::tests, 0);
  std::vector<VolumePhoton> photons;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    const double z = rng.uniform();
    const double u = rng.uniform();
    const Vec3 d = sample_sphere(u, rng.uniform());
    photons.push_back({Vec3(x, y, z), d, 0.5 + rng.uniform(), i % 4 == 0 ? 2U : 1U});
  }
  return photons;
}

// The definition, by sorting all photons.
ReducedIncident brute_force(std::vector<VolumePhoton> photons, const Vec3& x, const Medium& m,
                            const EstimateOptions& options, const RayCaster& caster) {
  std::erase_if(photons, [](const VolumePhoton& p) { return p.order != 1; });
  std::sort(photons.begin(), photons.end(), [&](const VolumePhoton& a, const VolumePhoton& b) {
    return (a.position - x).squaredNorm() < (b.position - x).squaredNorm();
  });
  const double kth = (photons[options.nearest - 1].position - x).norm();
  const double largest = options.max_radius / m.sigma_t();
  const double radius =
      options.estimator == DensityEstimator::radius ? largest : std::min(kth, largest);
  const bool smooth = options.estimator == DensityEstimator::kernel;
  const double volume =
      kernel_moments_inside(x, radius, smooth ? RadialKernel::smooth : RadialKernel::ball, caster,
                            0)
          .mass;
  ReducedIncident result;
  for (const VolumePhoton& p : photons) {
    if ((p.position - x).norm() >= radius) break;
    const double s2 = (p.position - x).squaredNorm() / (radius * radius);
    const double weight =
        (options.undo_attenuation ? std::exp(m.sigma_t() * p.direction.dot(p.position - x)) : 1.0) *
        (smooth ? (1.0 - s2) * (1.0 - s2) : 1.0);
    result.U_ri += weight * p.power / (4.0 * pi * m.sigma_t() * volume);
    result.Q_ri += m.g * m.sigma_s / m.sigma_t() * weight * p.power / volume * p.direction;
  }
  return result;
}

TEST(PhotonMap, AgreesWithASumOverAllPhotons) {
  const Medium m{0.2, 1.8, 0.7, 1.0, 0.0};
  const Scene scene = scene_of({}, {translucent(box_mesh(Vec3::Zero(), Vec3::Ones()), m)});
  const auto caster = caster_of(scene);
  const std::vector<VolumePhoton> photons = random_photons(2000);
  const VolumePhotonMap map(photons, m);
  EXPECT_EQ(map.size(), 1500U);
  constexpr double rounding = 1e-12;  // relative; the order of the sums differs
  for (const bool undo : {true, false}) {
    // The k-th photon sets the radius, then max_radius does, then it alone may.
    for (const EstimateOptions& options :
         {EstimateOptions{50, 1.0, undo, DensityEstimator::nearest, false, false},
          EstimateOptions{1000, 0.4, undo, DensityEstimator::nearest, false, false},
          EstimateOptions{2, 0.3, undo, DensityEstimator::radius, false, false},
          EstimateOptions{300, 1.0, undo, DensityEstimator::kernel, false, false}}) {
      for (const Vec3& x :
           {Vec3(0.5, 0.5, 0.5), Vec3(0.4, 0.3, 1.0), Vec3(1, 1, 0), Vec3(0.9, 0, 0.1)}) {
        const ReducedIncident estimate = map.estimate(x, options, *caster, 0);
        const ReducedIncident exact = brute_force(photons, x, m, options, *caster);
        EXPECT_NEAR(estimate.U_ri, exact.U_ri, rounding * exact.U_ri);
        EXPECT_LT((estimate.Q_ri - exact.Q_ri).norm(), rounding * exact.U_ri);
      }
    }
  }
}

// Uniform photons in a cube: (k - 1)/V_k has exactly the density as its mean, where k/V_k would be
// k/(k - 1) = 25 % too much. Its spread is 1/sqrt(k - 2) = 58 %: 1.3 % for the mean of 2000 maps.
TEST(PhotonMap, TheFarthestPhotonOnlySetsTheRadius) {
  const Medium m{0.5, 0.5, 0.0, 1.0, 0.0};
  const Scene scene = scene_of({}, {translucent(box_mesh(Vec3::Zero(), Vec3::Ones()), m)});
  const auto caster = caster_of(scene);
  constexpr int maps = 2000;
  constexpr int n = 200;
  double mean = 0.0;
  for (int i = 0; i < maps; ++i) {
    Rng rng(5, Stream::tests, static_cast<std::uint64_t>(i));
    std::vector<VolumePhoton> photons;
    for (int j = 0; j < n; ++j) {
      const double x = rng.uniform();
      const double y = rng.uniform();
      photons.push_back({Vec3(x, y, rng.uniform()), Vec3::UnitX(), 4.0 * pi / n, 1});
    }
    const VolumePhotonMap map(std::move(photons), m);
    mean += map.estimate(Vec3::Constant(0.5),
                         {5, 0.5, false, DensityEstimator::nearest, false, false}, *caster, 0)
                .U_ri /
            maps;
  }
  EXPECT_NEAR(mean, 1.0, sigmas / std::sqrt(3.0 * maps));
}

TEST(PhotonMap, EmptyMapIsExactlyDark) {
  const Medium m{0.2, 1.8, 0.7, 1.0, 0.0};
  const Scene scene = scene_of({}, {translucent(Sphere{}, m)});
  const ReducedIncident dark =
      VolumePhotonMap({}, m).estimate(Vec3(0, 0, 1), {}, *caster_of(scene), 0);
  EXPECT_EQ(dark.U_ri, 0.0);
  EXPECT_EQ(dark.Q_ri, Vec3::Zero());
  EXPECT_EQ(dark.relative_standard_error, 0.0);
}

TEST(PhotonMap, AnEmptyBallIsNotTrusted) {
  const Medium m{0.2, 1.8, 0.7, 1.0, 0.0};
  const Scene scene = scene_of({}, {translucent(box_mesh(Vec3::Zero(), Vec3::Ones()), m)});
  const VolumePhotonMap map({{Vec3(0.1, 0.1, 0.1), Vec3::UnitX(), 1.0, 1}}, m);
  const ReducedIncident far = map.estimate(Vec3(0.9, 0.9, 0.9), {}, *caster_of(scene), 0);
  EXPECT_EQ(far.U_ri, 0.0);
  EXPECT_TRUE(std::isinf(far.relative_standard_error));
}

// Mean of an estimate over many points whose balls do not overlap, and its standard error from
// their spread.
struct Mean {
  double value = 0.0, standard_error = 0.0;
};
Mean mean_of(const std::vector<double>& x) {
  Mean m;
  double squares = 0.0;
  const double n = static_cast<double>(x.size());
  for (const double v : x) m.value += v / n;
  for (const double v : x) squares += (v - m.value) * (v - m.value);
  m.standard_error = std::sqrt(squares / (n - 1.0) / n);
  return m;
}

// 100 points: Student's t with 99 degrees of freedom exceeds 5.3 with probability 7e-7.
constexpr double student_sigmas = 5.3;

// A slab lit at right angles by irradiance E: with T the Fresnel transmittance at normal incidence
// and no light back from below (b = 6 mean free paths; the bottom returns 3 % of e^-6),
//   U_ri(z) = T E exp(-sigma_t z)/(4 pi),  Q_ri = g sigma_s T E exp(-sigma_t z) d.
class LitSlab : public ::testing::TestWithParam<Medium> {
 protected:
  static constexpr double E = 3.0;
  Medium medium_ = GetParam();
  Scene scene_ = scene_of({parallel_light(-Vec3::UnitZ(), E)},
                          {translucent(box_mesh(Vec3(-4, -4, -3), Vec3(4, 4, 0)), medium_)});
  std::unique_ptr<RayCaster> caster_ = caster_of(scene_);
  VolumePhotonMap map_{trace(scene_, Orders::first, 600'000, true).photons[0], medium_};
  double transmitted_ = (1.0 - fresnel_reflectance(1.0, medium_.ior)) * E;

  // U_ri and Q_ri along the light at 100 points at depth z.
  std::pair<Mean, Mean> at_depth(double z, const EstimateOptions& options) const {
    std::vector<double> U;
    std::vector<double> Q;
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        const Vec3 x(0.6 * (i - 4.5), 0.6 * (j - 4.5), -z);
        const ReducedIncident r = map_.estimate(x, options, *caster_, 0);
        U.push_back(r.U_ri);
        Q.push_back(-r.Q_ri.z());
      }
    }
    return {mean_of(U), mean_of(Q)};
  }
};

// Of the value: ball_volume_inside is exact to 1 % of the ball near the surface, in the mean over
// orientations 0.3 %; one orientation, 3 sigma.
constexpr double volume_error = 0.01;

TEST_P(LitSlab, AttenuationUndoneNoBias) {
  for (const double z : {0.0, 0.1, 0.5, 1.0}) {
    // r up to 0.5 mean free paths; in the second case set by the photons.
    for (const EstimateOptions& options :
         {EstimateOptions{100'000, 0.5}, EstimateOptions{40, 0.5}}) {
      const auto [U, Q] = at_depth(z, options);
      const double exact = transmitted_ * std::exp(-2.0 * z) / (4.0 * pi);
      const double exact_Q = medium_.g * medium_.sigma_s * 4.0 * pi * exact;
      EXPECT_LT(U.standard_error, 0.03 * exact);
      EXPECT_NEAR(U.value, exact, student_sigmas * U.standard_error + volume_error * exact) << z;
      EXPECT_NEAR(Q.value, exact_Q, student_sigmas * Q.standard_error + volume_error * exact_Q);
    }
  }
}

// The plain estimate averages exp(-sigma_t z) over the ball: with rho = sigma_t r, deep inside
//   3 (rho cosh rho - sinh rho)/rho^3
// times the value at the centre, and on the lit surface, over the half-ball,
//   3/2 int_0^1 exp(-rho s) (1 - s^2) ds = 3/2 (1/rho - 2/rho^3 + 2 (1 + rho) exp(-rho)/rho^3):
// 0.91 at rho = 0.25, 0.84 at 0.5. This bias is why the attenuation is undone.
TEST_P(LitSlab, PlainEstimateHasTheBiasOfItsBall) {
  constexpr double rho = 0.5;
  const EstimateOptions plain{100'000, rho, false, DensityEstimator::nearest, false, false};
  const double inside = 3.0 * (rho * std::cosh(rho) - std::sinh(rho)) / std::pow(rho, 3);
  const double surface = 1.5 * (1.0 / rho - 2.0 / std::pow(rho, 3) +
                                2.0 * (1.0 + rho) * std::exp(-rho) / std::pow(rho, 3));
  EXPECT_NEAR(surface, 0.84, 0.005);
  const double at_surface = transmitted_ / (4.0 * pi);
  const double at_half = at_surface * std::exp(-1.0);
  const Mean U0 = at_depth(0.0, plain).first;
  const Mean U1 = at_depth(0.5, plain).first;
  EXPECT_NEAR(U0.value, surface * at_surface,
              student_sigmas * U0.standard_error + volume_error * at_surface);
  EXPECT_NEAR(U1.value, inside * at_half, student_sigmas * U1.standard_error);
}

// The stated standard errors are those of the spread: 100 pulls of a fixed radius have variance 1
// within 5 * sqrt(2/99).
TEST_P(LitSlab, StatedErrorsAreTheSpread) {
  const EstimateOptions options{100'000, 0.5};
  double stated = 0.0;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const ReducedIncident r =
          map_.estimate(Vec3(0.6 * (i - 4.5), 0.6 * (j - 4.5), -0.5), options, *caster_, 0);
      stated += std::pow(r.U_ri * r.relative_standard_error, 2) / 100.0;
    }
  const double spread = 100.0 * std::pow(at_depth(0.5, options).first.standard_error, 2);
  EXPECT_NEAR(spread / stated, 1.0, sigmas * std::sqrt(2.0 / 99.0));
}

INSTANTIATE_TEST_SUITE_P(Media, LitSlab,
                         ::testing::Values(Medium{0.2, 1.8, 0.0, 1.0, 0.0},
                                           Medium{0.2, 1.8, 0.8, 1.0, 0.0},
                                           Medium{0.2, 1.8, 0.8, 1.4, 0.0}));

// Index-matched sphere in parallel light: U_ri = E exp(-sigma_t s)/(4 pi), s = the way to the
// surface against the light, on the lit side, its rim, and in the dark. No bias is allowed but that
// of the lines behind beam_mass, 1 %. One estimate a point, its error as stated by it.
TEST(PhotonMap, SphereInParallelLight) {
  constexpr double bias = 0.01;
  const Medium m{0.5, 2.5, 0.5, 1.0, 0.0};
  const Scene scene = scene_of({parallel_light(Vec3(1, 0, 0), 1.0)}, {translucent(Sphere{}, m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, Orders::first, 1'500'000, true).photons[0], m);
  for (const Vec3& x :
       {Vec3(-0.8, 0, 0), Vec3(-0.5, 0.3, 0.2), Vec3(0, 0, 0), Vec3(-0.3, -0.5, 0.4),
        Vec3(-0.8, 0, 0.6), Vec3(0, 0.8, -0.6), Vec3(0.28, 0, 0.96)}) {
    const double s = x.x() + std::sqrt(std::max(0.0, 1.0 - x.y() * x.y() - x.z() * x.z()));
    const double exact = std::exp(-3.0 * s) / (4.0 * pi);
    const ReducedIncident r = map.estimate(x, {1'000'000, 0.4}, *caster, 0);
    EXPECT_LT(r.relative_standard_error, 0.1);
    EXPECT_NEAR(r.U_ri, exact, sigmas * r.relative_standard_error * exact + bias * exact);
    EXPECT_LT((r.Q_ri - m.g * m.sigma_s * 4.0 * pi * r.U_ri * Vec3::UnitX()).norm(), 1e-9 * r.U_ri);
  }
}

// A point light near a sphere: rays spread, light falls with the square of the distance. The same
// bounds; Q_ri points along the ray through x to the part of a ball's radius over the distance,
// squared.
TEST(PhotonMap, SphereNearAPointLight) {
  constexpr double bias = 0.01;
  constexpr double angle = 0.01;
  const Medium m{0.5, 2.5, 0.5, 1.0, 0.0};
  const Vec3 lamp(-2, 0.5, 0);
  const Scene scene =
      scene_of({PointLight{lamp, Spectrum::Constant(3.0)}}, {translucent(Sphere{}, m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, Orders::first, 1'500'000, true).photons[0], m);
  for (const Vec3& x : {Vec3(-0.8, 0, 0), Vec3(-0.5, 0.3, 0.2), Vec3(-0.8, 0, 0.6),
                        Vec3(-0.6, 0.8, 0), Vec3(0, 0, 0)}) {
    const Vec3 w = (x - lamp).normalized();
    const double s = x.dot(w) + std::sqrt(std::pow(x.dot(w), 2) + 1.0 - x.squaredNorm());
    const double exact = 3.0 * std::exp(-3.0 * s) / (4.0 * pi * (x - lamp).squaredNorm());
    const ReducedIncident r = map.estimate(x, {1'000'000, 0.5}, *caster, 0);
    EXPECT_LT(r.relative_standard_error, 0.1);
    EXPECT_NEAR(r.U_ri, exact, sigmas * r.relative_standard_error * exact + bias * exact);
    EXPECT_LT((r.Q_ri / (m.g * m.sigma_s * 4.0 * pi * r.U_ri) - w).norm(), angle);
  }
}

// Light gliding along two faces of a box, on those faces and edges: exp(-sigma_t z)/(4 pi).
TEST(PhotonMap, LightAlongAFace) {
  constexpr double bias = 0.01;
  const Medium m{0.2, 1.8, 0.7, 1.0, 0.0};
  const Scene scene = scene_of({parallel_light(Vec3(0.6, 0, -0.8), 1.0)},
                               {translucent(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 0)), m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, Orders::first, 500'000, true).photons[0], m);
  for (const Vec3& x : {Vec3(0.3, 1, -0.2), Vec3(0.3, -1, -0.4), Vec3(0.5, 1, 0)}) {
    const double exact = std::exp(2.0 * x.z() / 0.8) / (4.0 * pi);
    const ReducedIncident r = map.estimate(x, {1'000'000, 0.4}, *caster, 0);
    EXPECT_NEAR(r.U_ri, exact, sigmas * r.relative_standard_error * exact + bias * exact);
  }
}

// The same on edges that the light runs along, where two faces meet, and at a corner: U_ri was up
// to 60 times too high there while the ray from x started on the second face.
TEST(PhotonMap, LightAlongAnEdge) {
  constexpr double bias = 0.02;
  const Medium m{0.2, 1.8, 0.7, 1.0, 0.0};
  const Scene scene = scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                               {translucent(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 0)), m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, Orders::first, 500'000, true).photons[0], m);
  for (const Vec3& x :
       {Vec3(1, 1, -0.2), Vec3(-1, 1, -0.5), Vec3(1, -1, -0.8), Vec3(1, 1, -1), Vec3(-1, -1, 0)}) {
    const double exact = std::exp(2.0 * x.z()) / (4.0 * pi);
    const ReducedIncident r = map.estimate(x, {1'000'000, 0.4}, *caster, 0);
    EXPECT_NEAR(r.U_ri, exact, sigmas * r.relative_standard_error * exact + bias * exact);
  }
}

// Light from everywhere has no beams: what is left is the fitted slope. Under a sky of radiance L
// a wide slab has, with tau = sigma_t z, U_ri = (L/2) E_2(tau), E_2 = int_1^inf exp(-tau t)/t^2 dt:
// half of L on its surface. Mean of 100 points; allowed bias 2 %, of second differences.
TEST(PhotonMap, SlabUnderTheSky) {
  constexpr double bias = 0.02;
  const Medium m{0.2, 1.8, 0.7, 1.0, 0.0};
  const Scene scene =
      scene_of({sky(2.0)}, {translucent(box_mesh(Vec3(-4, -4, -3), Vec3(4, 4, 0)), m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, Orders::first, 1'000'000, true).photons[0], m);
  const auto E2 = [](double tau) {  // midpoint rule in mu = 1/t
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i) sum += std::exp(-tau * 1000.0 / (i + 0.5)) / 1000.0;
    return sum;
  };
  for (const double z : {0.0, 0.1, 0.4}) {
    std::vector<double> U;
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 10; ++j)
        U.push_back(
            map.estimate(Vec3(0.5 * (i - 4.5), 0.5 * (j - 4.5), -z), {400, 0.3}, *caster, 0).U_ri);
    const Mean mean = mean_of(U);
    const double exact = E2(2.0 * z);
    EXPECT_LT(mean.standard_error, 0.03 * exact);
    EXPECT_NEAR(mean.value, exact, student_sigmas * mean.standard_error + bias * exact) << z;
  }
}

// All orders under uniform radiance L without absorption: U = n^2 L at every point, on faces,
// edges and corners too. Relative error as stated, but photons of one path are correlated: a path
// of some 7 interactions puts a few into one ball; twice the Poisson error covers that.
TEST(PhotonMap, AllOrdersGiveUniformRadiance) {
  constexpr double correlation = 2.0;
  const double L = 0.7;
  const Medium m{0.0, 3.0, 0.3, 1.4, 0.0};
  const Scene scene = scene_of({sky(L)}, {translucent(box_mesh(Vec3::Zero(), Vec3(1, 2, 1)), m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map(trace(scene, Orders::all, 200'000, true).photons[0], m, false);
  for (const Vec3& x : {Vec3(0.5, 1, 0.5), Vec3(0.5, 1, 1), Vec3(0.4, 0, 0.6), Vec3(1, 0.7, 1),
                        Vec3(0, 0, 0), Vec3(0.95, 1.9, 0.9)}) {
    const ReducedIncident r = map.estimate(
        x, {1'000'000, 0.6, true, DensityEstimator::nearest, false, false}, *caster, 0);
    const double exact = 1.96 * L;
    EXPECT_NEAR(r.U_ri, exact,
                (correlation * sigmas * r.relative_standard_error + volume_error) * exact);
    EXPECT_LT(r.relative_standard_error, 0.04);
  }
}

}  // namespace
}  // namespace knotlight
