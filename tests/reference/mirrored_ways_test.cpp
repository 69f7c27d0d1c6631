#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/fresnel.h"
#include "core/phase_function.h"
#include "reference/path_scenes.h"
#include "reference/refracted_ways.h"

namespace knotlight {
namespace {

using namespace test;

constexpr double infinity = std::numeric_limits<double>::infinity();

// A box around the origin; its faces are -x, +x, -y, +y, -z, +z.
struct Box {
  Vec3 half;

  double area(std::size_t face) const { return 4.0 * half.prod() / half[axis(face)]; }
  static Eigen::Index axis(std::size_t face) { return static_cast<Eigen::Index>(face / 2); }
  static Vec3 normal(std::size_t face) {
    return (face % 2 == 1 ? 1.0 : -1.0) * Vec3::Unit(axis(face));
  }
  double to_face(std::size_t face, const Vec3& p, const Vec3& d) const {
    const Vec3 n = normal(face);
    return (half[axis(face)] - n.dot(p)) / n.dot(d);
  }
  struct Meeting {
    std::size_t face = 0;
    double t = 0.0;
  };
  // The first of the faces that the ray leaves by.
  Meeting exit(const Vec3& p, const Vec3& d) const {
    Meeting first{0, infinity};
    for (std::size_t face = 0; face < 6; ++face)
      if (normal(face).dot(d) > 0.0 && to_face(face, p, d) < first.t)
        first = {face, to_face(face, p, d)};
    return first;
  }
  // From outside, the last of those that it enters by, if it meets the box.
  std::optional<Meeting> entry(const Vec3& p, const Vec3& d) const {
    Meeting last{0, -infinity};
    for (std::size_t face = 0; face < 6; ++face)
      if (normal(face).dot(d) < 0.0 && to_face(face, p, d) > last.t)
        last = {face, to_face(face, p, d)};
    return last.t > 0.0 && last.t < exit(p, d).t ? std::optional(last) : std::nullopt;
  }
};

// Straight down into a box: off its bottom; or off its top and then its bottom. 20 000 draws, each
// with the odds R and R^2, and the same sums where short ways are preferred.
TEST(MirroredWays, OfAnUprightBeam) {
  constexpr double ior = 4.0;
  constexpr double sigma_t = 1.5;
  const Shape box = box_mesh(Vec3(-1, -1, 0), Vec3(1, 1, 1));
  const RefractingSurface surface(box, ior);
  const double z = 0.3;
  const double length[] = {z + 1.0, (1.0 - z) + 2.0};
  const double R = fresnel_reflectance(1.0, ior);
  for (const double preferred : {0.0, sigma_t}) {
    Mean arriving[2];
    std::vector<RefractedWay> ways;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Rng rng(3, Stream::tests, i);
      ways.clear();
      surface.find_mirrored(Vec3(0.2, 0.1, z), {Vec3::UnitZ(), true}, preferred, rng, ways);
      double left[2] = {0.0, 0.0};
      for (const RefractedWay& way : ways) {
        const std::size_t k = way.mirrors == 1 ? 0 : 1;
        EXPECT_NEAR(way.length, length[k], 1e-12);
        EXPECT_NEAR(way.start.z(), k == 0 ? -1.0 : 1.0, 1e-12);
        EXPECT_NEAR((way.crossing - Vec3(0.2, 0.1, 1.0)).norm(), 0.0, 1e-12);
        left[k] += way.gain * std::exp(-sigma_t * way.length);
      }
      for (std::size_t k = 0; k < 2; ++k) arriving[k].add(left[k]);
    }
    expect_mean(arriving[0], R * std::exp(-sigma_t * length[0]));
    expect_mean(arriving[1], R * R * std::exp(-sigma_t * length[1]));
  }
}

using PowerPerFace = std::array<Mean, 6>;

// Light tracing, with dice for everything: the power that leaves each face, per photon, in a way
// that a path from the eye is to find. Of a lamp without size: what was scattered, after at most
// most_mirrors reflections inside. Of an area light: everything, its mirror image too.
PowerPerFace power_by_photons(const Light& light, const TranslucentMaterial& material,
                              const Box& box, std::size_t photons) {
  const Medium m = material.medium(0);
  const bool sized = std::holds_alternative<AreaLight>(light);
  const double radius = box.half.norm();
  PowerPerFace leaving;
  for (std::size_t i = 0; i < photons; ++i) {
    Rng rng(11, Stream::tests, i);
    const auto pair = [&rng] {
      const double u = rng.uniform();
      return std::pair(u, rng.uniform());
    };
    Vec3 p;
    Vec3 d;
    double power = 0.0;
    const auto towards_box = [&] {
      const double distance = p.norm();
      const double cosine = std::sqrt(1.0 - radius * radius / (distance * distance));
      const auto [u, v] = pair();
      d = Frame(-p / distance).to_world(sample_cone(u, v, cosine));
      return 2.0 * std::numbers::pi * (1.0 - cosine);  // solid angle
    };
    if (const auto* point = std::get_if<PointLight>(&light)) {
      p = point->position;
      power = point->intensity[0] * towards_box();
    } else if (const auto* area = std::get_if<AreaLight>(&light)) {
      const auto [u, v] = pair();
      p = area->center + (2.0 * u - 1.0) * area->u + (2.0 * v - 1.0) * area->v;
      power = area->radiance[0] * area->area() * towards_box();
      power *= std::max(0.0, area->normal().dot(d));
    } else {
      const auto& beam = std::get<DirectionalLight>(light);
      d = beam.direction;
      const auto [u, v] = pair();
      const Eigen::Vector2d across = radius * sample_disc(u, v);
      p = Frame(d).to_world(Vec3(across.x(), across.y(), -2.0 * radius));
      power = beam.irradiance[0] * std::numbers::pi * radius * radius;
    }
    std::optional<std::size_t> out;
    if (const auto entered = box.entry(p, d)) {
      p += entered->t * d;
      const Vec3 n = Box::normal(entered->face);
      bool inside = rng.uniform() >= fresnel_reflectance(-n.dot(d), m.ior);
      if (inside)
        d = *refract(d, n, m.ior);
      else if (sized)
        out = entered->face;
      int mirrors = 0;
      for (bool scattered = false; inside;) {
        const auto [face, distance] = box.exit(p, d);
        const double flight = sample_free_flight(rng.uniform(), m.sigma_t());
        p += std::min(flight, distance) * d;
        if (flight < distance) {
          if (rng.uniform() >= m.albedo() || (!sized && mirrors > most_mirrors)) break;
          scattered = true;
          const auto [u, v] = pair();
          d = sample_henyey_greenstein(d, m.g, u, v);
        } else if (rng.uniform() < fresnel_reflectance(Box::normal(face).dot(d), 1.0 / m.ior)) {
          d = reflect(d, Box::normal(face));
          if (!scattered) ++mirrors;
        } else {
          inside = false;
          if (scattered || sized) out = face;
        }
      }
    }
    for (std::size_t face = 0; face < 6; ++face) leaving[face].add(out == face ? power : 0.0);
  }
  return leaving;
}

// The same by the radiance that the eye sees: pi times the area times its mean over places and,
// with the density cosine / pi, over directions.
PowerPerFace power_by_paths(const Traced& scene, const Box& box, std::size_t samples) {
  PowerPerFace leaving;
  for (std::size_t face = 0; face < 6; ++face) {
    const Vec3 n = Box::normal(face);
    const auto eye = [&](Rng& rng) -> Ray {
      Vec3 p;
      for (double& x : p) x = 2.0 * rng.uniform() - 1.0;
      p[Box::axis(face)] = n[Box::axis(face)];
      const double u = rng.uniform();
      const Vec3 d = Frame(n).to_world(sample_cosine_hemisphere(u, rng.uniform()));
      return {p.cwiseProduct(box.half) + 1e-3 * d, -d};
    };
    Mean radiance = scene.mean(samples, eye);
    const double scale = std::numbers::pi * box.area(face);
    radiance.sum *= scale;
    radiance.sum_of_squares *= scale * scale;
    leaving[face] = radiance;
  }
  return leaving;
}

// Each face in each scene, to 2 to 6 % (standard error); two-sided, false alarms 1e-6 per check.
// Without the mirrored ways 6 to 24 % of the lamps' light is missing, which 3 to 6 of the faces of
// each scene show.
TEST(MirroredWays, BoxesLeaveTheSamePowerByPathsAndByPhotons) {
  struct Case {
    std::string name;
    Light light;
    TranslucentMaterial material;
    Vec3 half;
  };
  const Vec3 cube = Vec3::Constant(0.5);
  const std::vector<Case> cases = {
      {"lamp over a face", PointLight{Vec3(0.1, 0.05, 2), grey(1)}, medium(0.3, 4, 0, 1.5), cube},
      {"over an edge", PointLight{Vec3(0.9, 0.05, 0.9), grey(1)}, medium(0.3, 3, 0.4, 1.4), cube},
      {"beside a face", PointLight{Vec3(1, 0.1, 0.2), grey(1)}, medium(0.3, 4, 0, 1.5), cube},
      {"over a plate", PointLight{Vec3(0.1, 0.05, 1), grey(1)}, medium(0.2, 5, 0.3, 1.4),
       Vec3(0.5, 0.5, 0.1)},
      {"slanting beam", DirectionalLight{Vec3(0.9, 0.3, -1).normalized(), grey(1)},
       medium(0.2, 2, 0.6, 1.4), cube},
      {"area light", AreaLight{Vec3(0.4, 0, 0.9), Vec3(0.4, 0, 0), Vec3(0, -0.4, 0), grey(1)},
       medium(0.2, 2, 0, 1.5), cube}};
  for (const Case& c : cases) {
    const Box box{c.half};
    const Traced scene({c.light}, {block(c.material, -c.half, c.half)});
    const PowerPerFace photons = power_by_photons(c.light, c.material, box, 100'000);
    const PowerPerFace paths = power_by_paths(scene, box, 2000);
    for (std::size_t face = 0; face < 6; ++face) {
      const double error = std::hypot(photons[face].standard_error(), paths[face].standard_error());
      EXPECT_NEAR(paths[face].mean(), photons[face].mean(), z_one_in_a_million * error)
          << c.name << ", face " << face;
    }
  }
}

}  // namespace
}  // namespace knotlight
