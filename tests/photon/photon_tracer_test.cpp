// The tracer through all orders against exact transport, the mean path length theorem and uniform
// radiance; the same bits for any number of threads.
#include "photon/photon_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "photon/photon_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::diffuse;
using testing_scenes::parallel_light;
using testing_scenes::scene_of;
using testing_scenes::sigmas;
using testing_scenes::sky;
using testing_scenes::slab_medium;
using testing_scenes::slab_scene;
using testing_scenes::trace;
using testing_scenes::translucent;
using Orders = TracerOptions::Orders;

struct SlabCase {
  const char* source;
  Medium medium;
  double R, T;       // exact, specular included
  double precision;  // half a unit of the last digit given
  std::size_t photons;
};

class Slab : public ::testing::TestWithParam<SlabCase> {};

// n arrivals of equal power: R, T and what is absorbed are binomial. 3 checks each.
TEST_P(Slab, ReflectionTransmissionAbsorption) {
  const SlabCase& c = GetParam();
  SCOPED_TRACE(c.source);
  const TraceResult r = trace(slab_scene(c.medium), Orders::all, c.photons);
  const EnergyAudit& slab = r.audit[0];
  const double n = static_cast<double>(slab.photons);
  ASSERT_GT(n, 0.5 * static_cast<double>(c.photons));
  const auto allowance = [&](double p) {
    return sigmas * std::sqrt(p * (1.0 - p) / n) + c.precision;
  };
  const double T = r.audit[1].incident / slab.incident;
  const double R = (slab.reflected + slab.escaped) / slab.incident - T;
  const double absorbed = 1.0 - c.R - c.T;
  EXPECT_NEAR(T, c.T, allowance(c.T));
  EXPECT_NEAR(R, c.R, allowance(c.R));
  EXPECT_NEAR(slab.absorbed_fraction(), absorbed, allowance(absorbed) + c.precision);
  EXPECT_LT(slab.lost, 1e-5 * slab.incident);
  // The batches' spread must be that of a count too, within the chi of 256 of them: 5 sigma of the
  // spread of a standard error is 5/sqrt(2 * 255) = 22 %.
  EXPECT_NEAR(slab.standard_error_absorbed / slab.incident,
              std::sqrt(absorbed * (1.0 - absorbed) / n),
              0.22 * std::sqrt(absorbed * (1.0 - absorbed) / n));
}

INSTANTIATE_TEST_SUITE_P(
    Exact, Slab,
    ::testing::Values(
        SlabCase{"[vdH80]", slab_medium(2, 0.9, 0.75, 1.0), 0.09739, 0.66096, 5e-6, 500'000},
        SlabCase{"adding-doubling", slab_medium(10, 0.99, 0.0, 1.0), 0.74093, 0.08476, 5e-6,
                 500'000},
        SlabCase{"adding-doubling", slab_medium(10, 0.99, 0.0, 1.4), 0.6219, 0.1026, 5e-5, 500'000},
        // A half-space: of what gets 40 mean free paths deep 1e-9 comes back.
        SlabCase{"[G55]", slab_medium(40, 0.9, 0.0, 1.5), 0.2600, 0.0, 5e-5, 500'000}));

// Uniform radiance L from everywhere fills a body that does not absorb with radiance n^2 L,
// whatever it scatters like: the interactions are sigma_t 4 pi n^2 L V, the arrivals pi L S, so a
// photon that arrives interacts sigma_t n^2 4 V/S times in the mean. (n = 1: mean chord length.)
// Standard error from the batches.
TEST(PhotonTracer, MeanPathLengthUnderUniformLight) {
  const Medium matched{0.0, 3.0, 0.5, 1.0, 0.0};
  const Medium refracting{0.0, 3.0, 0.5, 1.4, 0.0};
  for (const Shape& shape :
       {Shape(Sphere{Vec3(0, 0, 0), 1.0}), Shape(box_mesh(Vec3(0, 0, 0), Vec3(1, 2, 3)))}) {
    for (const Medium& m : {matched, refracting}) {
      const TraceResult r =
          trace(scene_of({sky(0.5)}, {translucent(shape, m)}), Orders::all, 100'000);
      const EnergyAudit& a = r.audit[0];
      const double path = a.interactions / m.sigma_t() / a.incident;
      const double standard_error = a.standard_error_interactions / m.sigma_t() / a.incident;
      const double exact = m.ior * m.ior * 4.0 * volume(shape) / surface_area(shape);
      EXPECT_LT(standard_error, 0.02 * exact);
      EXPECT_NEAR(path, exact, sigmas * standard_error);
      EXPECT_NEAR(a.incident, 0.5 * pi * surface_area(shape),
                  sigmas * a.standard_error_incident + 1e-9 * a.incident);
      EXPECT_EQ(a.absorbed, 0.0);
    }
  }
}

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(PhotonTracer, SameBitsForAnyNumberOfThreads) {
  const Scene scene =
      scene_of({sky(0.5), parallel_light(Vec3(1, 0, -1), 1.0)},
               {translucent(Sphere{Vec3(0, 0, 1), 1.0}, {0.1, 3.0, 0.5, 1.3, 0.0}),
                translucent(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 0)), {0.1, 2.0, 0.0, 1.0, 0.0})});
  const TraceResult one = trace(scene, Orders::all, 20'000, true, 1);
  const TraceResult two = trace(scene, Orders::all, 20'000, true, 2);
  const TraceResult other_seed = trace(scene, Orders::all, 20'000, true, 2, 2);
  EXPECT_TRUE(same_bits(one.emitted, two.emitted));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(same_bits(one.audit[i].absorbed, two.audit[i].absorbed));
    EXPECT_TRUE(
        same_bits(one.audit[i].standard_error_absorbed, two.audit[i].standard_error_absorbed));
    EXPECT_FALSE(same_bits(one.audit[i].absorbed, other_seed.audit[i].absorbed));
    ASSERT_EQ(one.photons[i].size(), two.photons[i].size());
    ASSERT_GT(one.photons[i].size(), 1000U);
    for (std::size_t p = 0; p < one.photons[i].size(); ++p) {
      const VolumePhoton& a = one.photons[i][p];
      const VolumePhoton& b = two.photons[i][p];
      ASSERT_TRUE(a.position == b.position && a.direction == b.direction && a.order == b.order &&
                  same_bits(a.power, b.power));
    }
  }
}

TEST(PhotonTracer, EmissionAloneNeedsNoPhotons) {
  const Scene scene = scene_of({}, {translucent(Sphere{}, {1.0, 1.0, 0.0, 1.0, 2.0})});
  const TraceResult r = trace(scene, Orders::first, 1000, true);
  ASSERT_EQ(r.photons.size(), 1U);
  EXPECT_TRUE(r.photons[0].empty());
  EXPECT_EQ(r.emitted, 0.0);
  EXPECT_EQ(r.audit[0].incident, 0.0);
}

TEST(PhotonTracer, NothingTranslucent) {
  const Scene scene = scene_of({sky(1.0)}, {diffuse(Sphere{})});
  EXPECT_EQ(trace(scene, Orders::all, 1000).audit[0].incident, 0.0);
}

}  // namespace
}  // namespace knotlight
