// Single rules of the walk against closed forms: Fresnel at entry and exit, attenuation, surfaces
// that touch, opaque things inside, lights inside. All photons carry equal power here, so counts
// are binomial.
#include "photon/photon_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "photon/photon_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::diffuse;
using testing_scenes::parallel_light;
using testing_scenes::scene_of;
using testing_scenes::sigmas;
using testing_scenes::trace;
using testing_scenes::translucent;
using Orders = TracerOptions::Orders;

constexpr std::size_t emitted = 60'000;

// Expects the share of `part` in the incident power to be p, within 5 standard errors of a count.
void expect_share(double part, const EnergyAudit& audit, double p) {
  const double n = static_cast<double>(audit.photons);
  ASSERT_GT(n, 1000.0);
  constexpr double rounding = 1e-9;  // p may be 0 or 1
  EXPECT_NEAR(part / audit.incident, p, sigmas * std::sqrt(p * (1.0 - p) / n) + rounding);
}

// Every photon's power must be in one of the parts.
void expect_sums(const EnergyAudit& a) {
  EXPECT_NEAR(a.reflected + a.absorbed + a.escaped + a.unfollowed + a.lost, a.incident,
              1e-12 * a.incident + 1e-300);
}

Shape unit_box() {
  return box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
}

TEST(PhotonWalk, AttenuationAlongTheRay) {
  const Scene scene = scene_of({parallel_light(-Vec3::UnitZ(), 2.0)},
                               {translucent(unit_box(), {0.5, 1.0, 0.3, 1.0, 0.0})});
  const TraceResult r = trace(scene, Orders::first, emitted);
  expect_share(r.audit[0].escaped_unscattered, r.audit[0], std::exp(-1.5));
  expect_share(r.audit[0].unfollowed, r.audit[0], 1.0 - std::exp(-1.5));
  EXPECT_EQ(r.audit[0].reflected, 0.0);
  EXPECT_EQ(r.audit[0].lost, 0.0);
  expect_sums(r.audit[0]);
  // Power in: irradiance times area; of all that is emitted, a binomial share again.
  const double p = 1.0 / (pi * 0.75);
  EXPECT_NEAR(r.emitted, 2.0 * pi * 0.75, 1e-9);
  EXPECT_NEAR(r.audit[0].incident / r.emitted, p, sigmas * std::sqrt(p * (1.0 - p) / emitted));
}

TEST(PhotonWalk, FresnelAtEntry) {
  for (const double degrees : {0.0, 60.0}) {
    const double theta = degrees * pi / 180.0;
    const Scene scene = scene_of(
        {parallel_light(Vec3(std::sin(theta), 0, -std::cos(theta)), 1.0)},
        {translucent(box_mesh(Vec3(0, 0, 0), Vec3(1000, 1000, 1)), {1.0, 1000.0, 0.0, 1.4, 0.0})});
    const TraceResult r = trace(scene, Orders::first, emitted);
    // The side that faces the light takes 1/1000 * tan(theta) of it: less than the noise.
    expect_share(r.audit[0].reflected, r.audit[0], fresnel_reflectance(std::cos(theta), 1.4));
    expect_sums(r.audit[0]);
  }
}

// Slab of two touching boxes and a detector below: without scattering, what crosses N = 4 surfaces
// of equal reflectance R in any order of reflections is (1-R)/(1+(N-1)R), as nothing is absorbed.
TEST(PhotonWalk, TouchingBoxesAreCrossedOneAfterTheOther) {
  constexpr double nearly_clear = 1e-9;  // 1/length: no interaction in 1e5 passes
  const Medium glass{nearly_clear, 0.0, 0.0, 1.5, 0.0};
  const Scene scene = scene_of(
      {parallel_light(-Vec3::UnitZ(), 1.0)},
      {translucent(unit_box(), glass), translucent(box_mesh(Vec3(0, 0, -1), Vec3(1, 1, 0)), glass),
       diffuse(quad_mesh(Vec3(0.5, 0.5, -1.5), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)))});
  const TraceResult r = trace(scene, Orders::all, emitted);
  const double R = 0.04;
  // Of all that is emitted towards the sphere of radius sqrt(1.5), a unit area's meets the boxes.
  const double p = (1.0 - R) / (1.0 + 3.0 * R) / (pi * 1.5);
  EXPECT_NEAR(r.audit[2].incident / r.emitted, p, sigmas * std::sqrt(p * (1.0 - p) / emitted));
  for (const EnergyAudit& audit : r.audit) {
    EXPECT_LT(audit.lost, 1e-12);
    expect_sums(audit);
  }
}

TEST(PhotonWalk, LightEntersATouchingBoxAtOrderOne) {
  const Scene scene =
      scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
               {translucent(unit_box(), {1.0, 0.5, 0.0, 1.0, 0.0}),
                translucent(box_mesh(Vec3(0, 0, -1), Vec3(1, 1, 0)), {0.2, 0.5, 0.0, 1.0, 0.0})});
  const TraceResult r = trace(scene, Orders::first, emitted, true);
  expect_share(r.audit[1].incident, r.audit[0], std::exp(-1.5));
  expect_share(r.audit[1].unfollowed, r.audit[1], 1.0 - std::exp(-0.7));
  ASSERT_FALSE(r.photons[1].empty());
  for (const VolumePhoton& p : r.photons[1]) {
    EXPECT_EQ(p.order, 1U);
    EXPECT_LE(p.position.z(), 0.0);
  }
}

// A box that stands on a table: from inside, its own bottom comes first, then the table.
//   onto the table: (1-R)^2 e / (1 - R^2 e^2),  e = exp(-sigma_t h), nothing scattered.
TEST(PhotonWalk, BoxOnATable) {
  const double e = std::exp(-0.7);
  for (const double ior : {1.0, 1.5}) {
    const Scene scene =
        scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                 {translucent(unit_box(), {0.7, 0.0, 0.0, ior, 0.0}),
                  diffuse(quad_mesh(Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)))});
    const TraceResult r = trace(scene, Orders::all, emitted);
    const double R = fresnel_reflectance(1.0, ior);
    expect_share(r.audit[1].incident, r.audit[0], (1 - R) * (1 - R) * e / (1 - R * R * e * e));
    EXPECT_EQ(r.audit[0].lost, 0.0);
    expect_sums(r.audit[0]);
  }
}

// The table shields what stands on it from below.
TEST(PhotonWalk, NoLightThroughTheTable) {
  const Scene scene =
      scene_of({parallel_light(Vec3::UnitZ(), 1.0)},
               {translucent(unit_box(), {0.7, 0.0, 0.0, 1.3, 0.0}),
                diffuse(quad_mesh(Vec3(0.5, 0.5, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)))});
  const TraceResult r = trace(scene, Orders::all, emitted);
  EXPECT_EQ(r.audit[0].incident, 0.0);
  EXPECT_GT(r.audit[1].incident, 0.0);
}

TEST(PhotonWalk, OpaqueQuadInsideAbsorbs) {
  const Scene scene =
      scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
               {translucent(unit_box(), {0.5, 0.5, 0.0, 1.0, 0.0}),
                diffuse(quad_mesh(Vec3(0.5, 0.5, 0.4), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)))});
  const TraceResult r = trace(scene, Orders::first, emitted, true);
  expect_share(r.audit[1].incident, r.audit[0], std::exp(-0.6));
  for (const VolumePhoton& p : r.photons[0]) EXPECT_GE(p.position.z(), 0.4);
  expect_sums(r.audit[0]);
}

TEST(PhotonWalk, LightInsideTheObject) {
  const PointLight lamp{Vec3(1, 2, 3), Spectrum::Constant(3.0)};
  const Scene scene =
      scene_of({lamp}, {translucent(Sphere{Vec3(1, 2, 3), 0.5}, {1.0, 1.0, 0.0, 1.4, 0.0})});
  const TraceResult r = trace(scene, Orders::first, emitted, true);
  EXPECT_NEAR(r.audit[0].incident, 12.0 * pi, 1e-9);
  // Radial rays, normal incidence from inside: exp(-1) reaches the surface, R of it comes back and
  // has the diameter before it, and so on.
  const double R = fresnel_reflectance(1.0, 1.0 / 1.4);
  const double e = std::exp(-1.0);
  expect_share(r.audit[0].escaped_unscattered, r.audit[0], e * (1.0 - R) / (1.0 - R * e * e));
}

// Around a body that absorbs nothing, in uniform light, the radiance inside is n^2 L however rough
// the surface, so the mean path per arrival is n^2 4V/S: the rough surface lets light in and out
// alike.
TEST(PhotonWalk, RoughSurfacesKeepTheBalance) {
  for (const double roughness : {0.3, 1.0}) {
    Scene scene = scene_of({testing_scenes::sky(1.0)},
                           {translucent(Sphere{Vec3::Zero(), 1.0}, {0.0, 3.0, 0.0, 1.4, 0.0})});
    std::get<TranslucentMaterial>(scene.objects[0].material).roughness = roughness;
    const TraceResult r = trace(scene, Orders::all, emitted);
    const EnergyAudit& a = r.audit[0];
    expect_sums(a);
    EXPECT_EQ(a.absorbed, 0.0);
    EXPECT_LT(a.lost, 1e-6 * a.incident);
    EXPECT_NEAR(a.interactions / 3.0 / a.incident, 1.96 * 4.0 / 3.0,
                sigmas * a.standard_error_interactions / 3.0 / a.incident);
    EXPECT_LT(a.standard_error_interactions, 0.02 * a.interactions);
  }
}

TEST(PhotonWalk, RoughnessOfAMatchedSurfaceIsNotSeen) {
  Scene scene = scene_of({testing_scenes::sky(1.0)},
                         {translucent(Sphere{Vec3::Zero(), 1.0}, {0.1, 3.0, 0.0, 1.0, 0.0})});
  const double smooth = trace(scene, Orders::all, 1000).audit[0].interactions;
  std::get<TranslucentMaterial>(scene.objects[0].material).roughness = 0.7;
  EXPECT_EQ(trace(scene, Orders::all, 1000).audit[0].interactions, smooth);
}

// Light that leaves a concave object arrives at it again. Under uniform radiance and without
// absorption the space around it stays filled with that radiance, so the arrivals, first and later
// ones together, are pi L S; and per arrival the mean path inside is n^2 4 V/S. Almost nothing may
// be lost at the 2400 edges.
TEST(PhotonWalk, TorusMesh) {
  const TriangleMesh torus = testing_scenes::torus_mesh(40, 20);
  ASSERT_GT(volume(torus), 0.0);
  const Scene scene =
      scene_of({testing_scenes::sky(1.0)}, {translucent(torus, {0.0, 5.0, 0.5, 1.4, 0.0})});
  const TraceResult r = trace(scene, Orders::all, emitted);
  const EnergyAudit& a = r.audit[0];
  expect_sums(a);
  EXPECT_LT(a.lost, 1e-5 * a.incident);
  EXPECT_NEAR(a.incident, pi * surface_area(torus), sigmas * a.standard_error_incident);
  EXPECT_NEAR(a.interactions / 5.0 / a.incident,
              1.4 * 1.4 * 4.0 * volume(torus) / surface_area(torus),
              sigmas * a.standard_error_interactions / 5.0 / a.incident);
  EXPECT_LT(a.standard_error_incident, 0.01 * a.incident);
}

}  // namespace
}  // namespace knotlight
