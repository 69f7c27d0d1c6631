#include "photon/surroundings_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "photon/first_light_tracer.h"
#include "photon_scenes.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using namespace testing_scenes;
using std::numbers::pi;
using Orders = TracerOptions::Orders;

FirstLight first_light(const Scene& scene, std::size_t rays, std::uint64_t replicate = 0,
                       int threads = 2) {
  const auto caster = caster_of(scene);
  Stages stages(false);
  Stage stage(stages, "photons", rays);
  FirstLightOptions options;
  options.rays = rays;
  options.replicate = replicate;
  return trace_first_light(scene, *caster, 0, options, Workers(threads), stage);
}

double power(const std::vector<VolumePhoton>& photons) {
  double sum = 0.0;
  for (const VolumePhoton& p : photons) sum += p.power;
  return sum;
}

Object black(const Sphere& sphere) {
  return translucent(sphere, {1000.0, 0.0, 0.0, 1.0, 0.0});
}

// A black ball of radius r at the centre of a hollow sphere of radius R and reflectance rho, beside
// it a lamp. Wherever the wall reflects light, (r/R)^2 of it meets the ball (cosine law); so of
// what does not meet it at once rho F / (1 - rho (1 - F)), F = (r/R)^2, does in the end. 1/2e6 of
// the light passes the ball. 64 replicates of 2500 rays: beyond 6 standard errors lies 1e-7 of
// Student's t with 63 degrees of freedom.
TEST(SurroundingsLight, BallInAHollowSphere) {
  constexpr double r = 0.5, R = 2.0, d = 1.2, rho = 0.7, I = 2.0;
  Scene scene = scene_of({}, {black({Vec3::Zero(), r}), diffuse(Sphere{Vec3::Zero(), R}, rho)});
  scene.lights = {PointLight{Vec3(0, 0, d), Spectrum::Constant(I)}};
  test::Mean entered;
  for (std::uint64_t replicate = 0; replicate < 64; ++replicate)
    entered.add(power(first_light(scene, 2500, replicate).photons[0]));
  const double direct = 0.5 * (1.0 - std::sqrt(1.0 - (r / d) * (r / d)));
  const double F = (r / R) * (r / R);
  const double exact = 4.0 * pi * I * (direct + (1.0 - direct) * rho * F / (1.0 - rho * (1.0 - F)));
  EXPECT_NEAR(entered.mean(), exact, 6.0 * entered.standard_error() + 1e-5);
  EXPECT_LT(entered.standard_error(), 0.005 * exact);
}

// A sphere wholly above the plane of a small Lambertian surface gets (r/d)^2 cos(angle) of what
// that reflects. The sun throws the ball's shadow past the table; of the light that enters the ball
// from below all comes from the table. 24 replicates: six standard errors of their mean are a false
// alarm once in 50 000.
TEST(SurroundingsLight, BallAboveATableInTheSun) {
  constexpr double r = 0.5, h = 4.0, s = 1.0, rho = 0.8;
  const Vec3 sun = Vec3(1, 0, -1).normalized();
  const Scene scene =
      scene_of({parallel_light(sun, 3.0)},
               {black({Vec3(0, 0, h), r}),
                diffuse(quad_mesh(Vec3::Zero(), Vec3(s, 0, 0), Vec3(0, s, 0)), rho)});
  constexpr int cells = 100;
  double from_table = 0.0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Vec3 y(s * (2.0 * i + 1.0 - cells) / cells, s * (2.0 * j + 1.0 - cells) / cells, 0.0);
      const double distance = (Vec3(0, 0, h) - y).norm();
      from_table += rho * 3.0 * -sun.z() * std::pow(r / distance, 2) * h / distance *
                    std::pow(2.0 * s / cells, 2);
    }
  test::Mean ratio;
  for (std::uint64_t replicate = 0; replicate < 24; ++replicate) {
    const FirstLight light = first_light(scene, 400'000, replicate);
    double upwards = 0.0;
    for (const VolumePhoton& p : light.photons[0])
      if (p.direction.z() > 0.0) {
        upwards += p.power;
        ASSERT_LT((p.position - Vec3(0, 0, h)).dot(p.direction), 0.05 * r);  // where it gets in
      }
    ratio.add(upwards / from_table);
    EXPECT_NEAR(power(light.photons[0]) - upwards, 3.0 * pi * r * r, 2e-2);
  }
  EXPECT_NEAR(ratio.mean(), 1.0, 6.0 * ratio.standard_error());
  EXPECT_LT(ratio.standard_error(), 0.015);
}

// What a photon leaves behind, by object: power of the first interactions of every stay, of those
// without a scattering before, and moments of their places.
using Marks = Eigen::Array<double, 10, 1>;

void mark(Marks& marks, std::uint32_t object, const VolumePhoton& p, bool scattered) {
  const int base = object == 0 ? 0 : 5;
  marks[base] += p.power;
  if (scattered) return;
  marks[base + 1] += p.power;
  marks[base + 2] += p.power * (p.position.x() + 2.0);
  marks[base + 3] += p.power * p.position.z();
  marks[base + 4] += p.power * p.position.squaredNorm();
}

// Brute force: photons of the lights over the whole scene, dice at every surface.
void brute_force(const Scene& scene, const Passage& passage, const Emitter& emitter, Rng& rng,
                 double share, Marks& marks) {
  const EmittedPhoton start = emitter.sample(rng);
  LightRay light = passage.start(start.origin, start.direction);
  const double carried = start.power * share;
  bool scattered = false;
  int order = 0;
  while (true) {
    if (!light.inside) {
      const auto hit = passage.next_outside(light);
      if (!hit) return;
      light.position = hit->position;
      light.object = hit->object;
      light.on_surface = true;
      const auto* wall = std::get_if<DiffuseMaterial>(&scene.objects[hit->object].material);
      if (wall != nullptr) {
        if (rng.uniform() >= wall->reflectance[0]) return;
        const double side = light.direction.dot(hit->normal) < 0.0 ? 1.0 : -1.0;
        // Cosine law: the normal plus a point of the unit sphere.
        const double u = rng.uniform();
        light.direction = (side * hit->normal + sample_sphere(u, rng.uniform())).normalized();
        continue;
      }
      const double ior = scene.objects[hit->object].translucent()->ior;
      if (rng.uniform() < fresnel_reflectance(-light.direction.dot(hit->normal), ior)) {
        light.direction = reflect(light.direction, hit->normal);
      } else {
        light.direction = *refract(light.direction, hit->normal, ior);
        light.inside = true;
        order = 0;
      }
      continue;
    }
    const Medium medium = scene.objects[light.object].translucent()->medium(0);
    const double distance = -std::log1p(-rng.uniform()) / medium.sigma_t();
    const auto hit = passage.next_inside(light, distance);
    if (!hit) {
      light.position += distance * light.direction;
      light.on_surface = false;
      if (++order == 1)
        mark(marks, light.object, {light.position, light.direction, carried, 1}, scattered);
      if (rng.uniform() >= medium.albedo()) return;
      const double u = rng.uniform();
      light.direction = sample_sphere(u, rng.uniform());
      scattered = true;
      continue;
    }
    light.position = hit->position;
    light.on_surface = true;
    const double eta = 1.0 / medium.ior;
    if (rng.uniform() < fresnel_reflectance(light.direction.dot(hit->normal), eta)) {
      light.direction = reflect(light.direction, hit->normal);
    } else {
      light.direction = *refract(light.direction, hit->normal, eta);
      light.inside = false;
    }
  }
}

// Two boxes and a ball stand in the corner of a room, one of them on the floor with no gap, in the
// light of a lamp, the sun and a sky.
Scene room(double ior) {
  const Medium wax{0.6, 1.4, 0.0, ior, 0.0};
  Scene scene = scene_of({parallel_light(Vec3(-1, 0.3, -1), 2.0), sky(0.3)},
                         {translucent(box_mesh(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.8)), wax),
                          translucent(Sphere{Vec3(1.2, 0.2, 0.7), 0.6}, {0.5, 0.5, 0.0, 1.0, 0.0}),
                          diffuse(quad_mesh(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 2, 0)), 0.6),
                          diffuse(quad_mesh(Vec3(-2, 0, 1), Vec3(0, 2, 0), Vec3(0, 0, 1)), 0.9),
                          diffuse(Sphere{Vec3(0.1, 1.2, 0.5), 0.4}, 0.5)});
  scene.lights.emplace_back(PointLight{Vec3(0.3, -1.0, 1.5), Spectrum::Constant(1.0)});
  return scene;
}

// All light comes through a glass roof, so that what the floor throws on the ball was refracted.
Scene glasshouse() {
  return scene_of({parallel_light(Vec3(0.3, 0, -1), 2.0)},
                  {translucent(box_mesh(Vec3(-3, -3, 2), Vec3(3, 3, 2.3)), {0.6, 0.4, 0, 1.5, 0}),
                   translucent(Sphere{Vec3(0, 0, 0.8), 0.6}, {0.5, 0.5, 0.0, 1.0, 0.0}),
                   diffuse(quad_mesh(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 2, 0)), 0.9)});
}

// Lamps, surroundings and expected values against brute force: first interactions without any
// scattering before, object by object, with moments of where they are. Then with the walks of light
// that comes back: all first interactions of all stays. 64 batches of 12 500 photons against 64
// replicates of 2500 rays: beyond 6 standard errors lies 1e-7 of Student's t with 63 degrees of
// freedom.
TEST(SurroundingsLight, AgreesWithBruteForce) {
  for (const Scene& scene : {room(1.0), room(1.5), glasshouse()}) {
    const auto caster = caster_of(scene);
    const Passage passage(scene, *caster, 0);
    std::vector<const Shape*> shapes;
    for (const Object& object : scene.objects) shapes.push_back(&object.shape);
    const Emitter emitter(scene.lights, 0, sphere_around(shapes), passage.scene_bounds());
    constexpr std::uint64_t batches = 64;
    constexpr std::size_t per_batch = 12'500;
    Marks sum = Marks::Zero(), squares = Marks::Zero();
    for (std::uint64_t b = 0; b < batches; ++b) {
      Marks marks = Marks::Zero();
      Rng rng(7, Stream::tests, b);
      for (std::size_t i = 0; i < per_batch; ++i)
        brute_force(scene, passage, emitter, rng, 1.0 / per_batch, marks);
      sum += marks;
      squares += marks.square();
    }
    const Marks truth = sum / batches;
    const Marks truth_error = ((squares / batches - truth.square()) / (batches - 1.0)).sqrt();

    constexpr std::uint64_t replicates = 64;
    sum = squares = Marks::Zero();
    for (std::uint64_t k = 0; k < replicates; ++k) {
      Marks marks = Marks::Zero();
      const FirstLight light = first_light(scene, 2500, k);
      const TraceResult walks = trace(scene, Orders::returned, 2500, true, 2, k);
      for (const std::uint32_t object : {0U, 1U}) {
        for (const VolumePhoton& p : light.photons[object]) mark(marks, object, p, false);
        for (const VolumePhoton& p : walks.photons[object]) mark(marks, object, p, true);
      }
      sum += marks;
      squares += marks.square();
    }
    const Marks mean = sum / replicates;
    const Marks error = ((squares / replicates - mean.square()) / (replicates - 1.0)).sqrt();
    for (int i = 0; i < 10; ++i) {
      EXPECT_NEAR(mean[i], truth[i], 6.0 * std::hypot(error[i], truth_error[i]))
          << scene.objects.size() << " objects, mark " << i;
      EXPECT_LT(error[i], 0.02 * std::abs(truth[i])) << i;
    }
  }
}

// The collisions of Orders::first are of the same light as expected values. One trace, its error
// from batches: 5 standard errors, the low-discrepancy sum's being far smaller.
TEST(SurroundingsLight, CollisionsAndExpectedValuesAgree) {
  for (const double ior : {1.0, 1.5}) {
    const Scene scene = room(ior);
    const FirstLight light = first_light(scene, 100'000);
    const TraceResult walks = trace(scene, Orders::first, 200'000);
    for (const std::size_t object : {0U, 1U}) {
      const EnergyAudit& audit = walks.audit[object];
      const double error =
          std::hypot(audit.standard_error_interactions,
                     audit.standard_error_incident * audit.interactions / audit.incident);
      EXPECT_NEAR(power(light.photons[object]), audit.interactions, sigmas * error) << object;
      EXPECT_LT(error, 0.01 * audit.interactions);
    }
  }
}

TEST(SurroundingsLight, EnergyAuditCloses) {
  const TraceResult r = trace(room(1.5), Orders::all, 20'000);
  for (const EnergyAudit& a : r.audit) {
    EXPECT_NEAR(a.reflected + a.absorbed + a.escaped + a.unfollowed + a.lost, a.incident,
                1e-12 * a.incident);
    EXPECT_LT(a.lost, 1e-4 * a.incident);
  }
  for (const std::size_t wall : {2U, 3U, 4U}) EXPECT_GT(r.audit[wall].reflected, 0.0);
}

// A reflecting ball inside a medium sends light back into it: all that a lamp at the rim of a
// nearly clear body gives either leaves it or is absorbed by the inner ball.
TEST(SurroundingsLight, InclusionsReflectToo) {
  Scene scene = scene_of({parallel_light(-Vec3::UnitZ(), 1.0)},
                         {translucent(Sphere{Vec3::Zero(), 1.0}, {1e-9, 0.0, 0.0, 1.0, 0.0}),
                          diffuse(Sphere{Vec3::Zero(), 0.5}, 0.6)});
  const TraceResult r = trace(scene, Orders::all, 100'000);
  const EnergyAudit& stone = r.audit[1];
  EXPECT_NEAR(stone.incident / (pi * 0.25), 1.0, sigmas * 2.0 / std::sqrt(25'000.0));
  const double n = static_cast<double>(stone.photons);
  EXPECT_NEAR(stone.reflected / stone.incident, 0.6, sigmas * std::sqrt(0.24 / n));
  EXPECT_NEAR(r.audit[0].incident, r.audit[0].escaped, 1e-6);
}

TEST(SurroundingsLight, NoneFromBlackOnes) {
  Scene scene = room(1.0);
  for (std::size_t i = 2; i < scene.objects.size(); ++i)
    scene.objects[i].material = DiffuseMaterial{Spectrum::Zero()};
  const auto caster = caster_of(scene);
  const Passage passage(scene, *caster, 0);
  const SurroundingsLight light(scene, *caster, passage);
  EXPECT_FALSE(light.any());
  const Emitter emitter(scene.lights, 0, *passage.target(), passage.scene_bounds());
  EXPECT_EQ(light.photons_beside(emitter, 0, 1000), 0U);
}

// A lamp that shines on the ceiling alone: no photon of its own goes to the ball, all comes by way
// of the ceiling.
TEST(SurroundingsLight, IndirectLightAlone) {
  Scene scene =
      scene_of({}, {black({Vec3::Zero(), 0.5}),
                    diffuse(quad_mesh(Vec3(0, 0, 3), Vec3(2, 0, 0), Vec3(0, 2, 0)), 0.5)});
  scene.lights = {
      AreaLight{Vec3(0, 0, 1), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Spectrum::Constant(100.0)}};
  EXPECT_GT(power(first_light(scene, 10'000).photons[0]), 0.01);
  EXPECT_GT(trace(scene, Orders::first, 10'000).audit[0].incident, 0.01);
}

TEST(SurroundingsLight, SameBitsForAnyNumberOfThreads) {
  const Scene scene = room(1.5);
  const FirstLight one = first_light(scene, 20'000, 0, 1);
  const FirstLight three = first_light(scene, 20'000, 0, 3);
  ASSERT_EQ(one.photons[0].size(), three.photons[0].size());
  for (std::size_t i = 0; i < one.photons[0].size(); ++i) {
    ASSERT_EQ(one.photons[0][i].position, three.photons[0][i].position);
    ASSERT_EQ(one.photons[0][i].power, three.photons[0][i].power);
  }
  const TraceResult a = trace(scene, Orders::returned, 5000, true, 1);
  const TraceResult b = trace(scene, Orders::returned, 5000, true, 3);
  ASSERT_EQ(a.photons[1].size(), b.photons[1].size());
  for (std::size_t i = 0; i < a.photons[1].size(); ++i)
    ASSERT_EQ(a.photons[1][i].position, b.photons[1][i].position);
}

}  // namespace
}  // namespace knotlight
