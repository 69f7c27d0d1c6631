#include "reference/refracted_ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double ior = 1.4;

struct Pair {
  Vec3 p;
  LightPlace light;
};

// Any point of the inner `within` of the ball, and a beam (even i) or lamp (odd) from anywhere,
// that nearest to furthest from the centre; all lengths in radii.
Pair random_pair(std::uint64_t seed, std::uint64_t i, double within, double nearest,
                 double furthest, const Sphere& ball = {}) {
  Rng rng(seed, Stream::tests, i);
  const auto direction = [&rng] {
    const double u = rng.uniform();
    return sample_sphere(u, rng.uniform());
  };
  const Vec3 p = ball.center + ball.radius * within * std::cbrt(rng.uniform()) * direction();
  const Vec3 w = direction();
  const double distance = nearest + (furthest - nearest) * rng.uniform();
  const bool beam = i % 2 == 0;
  return {p, {beam ? w : Vec3(ball.center + ball.radius * distance * w), beam}};
}

// A bumpy closed mesh with normals in all directions, around the unit sphere's size.
TriangleMesh bumpy_mesh() {
  TriangleMesh mesh = refine(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1)), 0.25);
  for (Vec3& v : mesh.vertices) {
    v.normalize();
    v *= 1.0 + 0.1 * std::sin(5.0 * v.x()) * std::sin(4.0 * v.y() + 1.0);
  }
  return mesh;
}

std::vector<RefractedWay> ways_to(const Shape& shape, const Vec3& p, const LightPlace& light) {
  std::vector<RefractedWay> ways;
  RefractingSurface(shape, ior).find(p, light, ways);
  return ways;
}

// Light that starts where the way's does, in the direction given, is refracted at the sphere or at
// the plane (curvature 0) and followed to the plane across the way through its inner end: where it
// gets to.
Vec3 refracted_to_plane(const Vec3& start, const Vec3& d, const RefractedWay& way,
                        const Vec3& normal, double radius) {
  double t = 0.0;
  Vec3 n = normal;
  if (radius > 0.0) {
    const Vec3 from_center = start - (way.crossing - radius * normal);
    const double b = from_center.dot(d);
    t = -b - std::sqrt(b * b - from_center.squaredNorm() + radius * radius);
    n = (from_center + t * d) / radius;
  } else {
    t = normal.dot(way.crossing - start) / normal.dot(d);
  }
  const Vec3 crossing = start + t * d;
  const Vec3 inside = *refract(d, n, ior);
  const Vec3 end = way.crossing - way.length * way.inside;
  return crossing + way.inside.dot(end - crossing) / way.inside.dot(inside) * inside;
}

// Solid angle at the lamp (or area across the beam) over the area across the way at its inner end,
// by three rays a little apart. Central differences: the error is of the order of step^2.
double gain_by_rays(const RefractedWay& way, const LightPlace& light, const Vec3& normal,
                    double radius) {
  constexpr double step = 1e-4;
  const Vec3 d = -way.outside;
  const Frame frame(d);
  Vec3 spread[2];
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 aside = axis == 0 ? frame.t : frame.b;
    const auto end = [&](double sign) -> Vec3 {
      if (light.at_infinity)
        return refracted_to_plane(way.crossing - 3.0 * d + sign * step * aside, d, way, normal,
                                  radius);
      return refracted_to_plane(light.place, (d + sign * step * aside).normalized(), way, normal,
                                radius);
    };
    spread[axis] = (end(1.0) - end(-1.0)) / (2.0 * step);
  }
  return 1.0 / spread[0].cross(spread[1]).norm();
}

TEST(RefractedWays, ObeySnellAndBeginAndEndWhereTheyShould) {
  const std::vector<Shape> shapes = {Sphere{}, bumpy_mesh()};
  for (const Shape& shape : shapes)
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto [p, light] = random_pair(1, i, 0.8, 3.0, 3.0);
      for (const RefractedWay& way : ways_to(shape, p, light)) {
        EXPECT_NEAR((p + way.length * way.inside - way.crossing).norm(), 0.0, 1e-12);
        if (!light.at_infinity) {
          EXPECT_NEAR((way.crossing + way.outer_length * way.outside - light.place).norm(), 0,
                      1e-12);
        }
        // The normal is along outside - ior inside; refracting there leads to the light.
        const Vec3 n = (ior * way.inside - way.outside).normalized();
        const auto refracted = refract(way.inside, n, 1.0 / ior);
        ASSERT_TRUE(refracted);
        EXPECT_NEAR((*refracted - way.outside).norm(), 0.0, 1e-9);
        if (std::holds_alternative<Sphere>(shape)) {
          EXPECT_NEAR((n - way.crossing).norm(), 0.0, 1e-8);
        }
      }
    }
}

TEST(RefractedWays, GainIsThatOfNeighbouringRays) {
  const std::vector<Shape> shapes = {Sphere{}, bumpy_mesh()};
  int compared = 0;
  for (const Shape& shape : shapes)
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto [p, light] = random_pair(2, i, 0.8, 2.0, 2.0);
      const bool round = std::holds_alternative<Sphere>(shape);
      for (const RefractedWay& way : ways_to(shape, p, light)) {
        const Vec3 n = (ior * way.inside - way.outside).normalized();
        const double cos_i = n.dot(way.outside);
        // Near grazing rays and foci, differences of rays this far apart mean nothing.
        if (cos_i < 0.2 || way.gain > 3.0) continue;
        const double expected = gain_by_rays(way, light, n, round ? 1.0 : 0.0);
        EXPECT_NEAR(way.gain, expected, 2e-4 * expected) << "round " << round << ", light " << i;
        EXPECT_NEAR(way.transmitted, 1.0 - fresnel_reflectance(cos_i, ior), 1e-12);
        ++compared;
      }
    }
  EXPECT_GT(compared, 100);
}

// Photons of a lamp, refracted into a ball, counted where they pass through a small sphere inside:
// length in it over its volume, times power, is 4 pi times the mean intensity, for a single
// direction the irradiance across it. 400 000 photons, about 2500 of which pass; z within 4.9
// (false alarm 1e-6), and 1 % for the change of the irradiance over the sphere.
TEST(RefractedWays, GainIsThatOfCountedPhotons) {
  const Vec3 lamp(0.5, 0.2, 2.5);
  const Vec3 p(0.2, -0.3, 0.1);
  constexpr double radius = 0.08;
  constexpr std::size_t photons = 400'000;
  const double distance = lamp.norm();
  const double cosine = std::sqrt(1.0 - 1.0 / (distance * distance));
  test::Mean flux;
  for (std::uint64_t i = 0; i < photons; ++i) {
    Rng rng(3, Stream::tests, i);
    const double u = rng.uniform();
    const Vec3 d = Frame(-lamp / distance).to_world(sample_cone(u, rng.uniform(), cosine));
    const double b = lamp.dot(d);
    const double under = b * b - lamp.squaredNorm() + 1.0;
    double length = 0.0;
    if (under > 0.0) {
      const Vec3 n = lamp + (-b - std::sqrt(under)) * d;
      const Vec3 inside = *refract(d, n, ior);
      const Vec3 to_p = p - n;
      const double near = to_p.dot(inside);
      const double off2 = to_p.squaredNorm() - near * near;
      if (off2 < radius * radius && near > 0.0)
        length =
            2.0 * std::sqrt(radius * radius - off2) * (1.0 - fresnel_reflectance(-d.dot(n), ior));
    }
    flux.add(length * 2.0 * pi * (1.0 - cosine) / (4.0 / 3.0 * pi * std::pow(radius, 3)));
  }
  double expected = 0.0;
  for (const RefractedWay& way : ways_to(Sphere{}, p, {lamp, false}))
    expected += way.gain * way.transmitted;
  EXPECT_NEAR(flux.mean(), expected,
              test::z_one_in_a_million * flux.standard_error() + 0.01 * expected);
}

// All roots of Snell's equation on the lit cap, by signs on a grid of 4000 angles.
TEST(RefractedWays, NoneIsMissedOnTheSphere) {
  const Sphere sphere{Vec3(0.1, 0.2, 0.3), 1.3};
  int several = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto [p, light] = random_pair(4, i, 0.98, 1.02, 4.02, sphere);
    const bool beam = light.at_infinity;
    const Vec3 to_light = beam ? light.place : Vec3(light.place - sphere.center);
    const double away = to_light.norm();
    const Vec3 w = to_light / away;
    const Vec3 from_center = p - sphere.center;
    const Vec3 side = (from_center - from_center.dot(w) * w).normalized();
    const double end = beam ? 0.5 * pi : std::acos(sphere.radius / away);
    constexpr int steps = 4000;
    std::size_t expected = 0;
    double before = 0.0;
    for (int k = 0; k <= steps; ++k) {
      const double phi = end * (2.0 * k / steps - 1.0);
      const Vec3 n = std::cos(phi) * w + std::sin(phi) * side;
      const Vec3 along = -std::sin(phi) * w + std::cos(phi) * side;
      const Vec3 at = sphere.center + sphere.radius * n;
      const Vec3 out = beam ? w : Vec3((light.place - at).normalized());
      const double f = along.dot(ior * (p - at).normalized() + out);
      if (k > 0 && (f < 0.0) != (before < 0.0)) ++expected;
      before = f;
    }
    const auto ways = ways_to(sphere, p, light);
    several += ways.size() > 1 ? 1 : 0;
    EXPECT_EQ(ways.size(), expected) << i;
  }
  EXPECT_GT(several, 10);
}

// The tree of facets against each facet as a surface of its own.
TEST(RefractedWays, TreeFindsWhatEachFacetFinds) {
  const TriangleMesh mesh = bumpy_mesh();
  const Shape shape = mesh;
  const RefractingSurface tree(shape, ior);
  EXPECT_FALSE(tree.quick());
  std::size_t found = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto [p, light] = random_pair(5, i, 0.8, 2.5, 2.5);
    std::vector<RefractedWay> ways;
    tree.find(p, light, ways);
    std::size_t expected = 0;
    for (const Triangle& triangle : mesh.triangles) {
      const Vec3& a = mesh.vertices[triangle[0]];
      const Vec3& b = mesh.vertices[triangle[1]];
      const Vec3& c = mesh.vertices[triangle[2]];
      const Shape single = TriangleMesh{{a, b, c}, {Triangle{0, 1, 2}}};
      const Vec3 normal = (b - a).cross(c - a);
      for (const RefractedWay& way : ways_to(single, p, light)) {
        // A single facet is one of few planes, so its ways are those of its bounds on the plane.
        const bool within = normal.dot((b - a).cross(way.crossing - a)) >= 0.0 &&
                            normal.dot((c - b).cross(way.crossing - b)) >= 0.0 &&
                            normal.dot((a - c).cross(way.crossing - c)) >= 0.0;
        expected += within ? 1 : 0;
      }
    }
    EXPECT_EQ(ways.size(), expected) << i;
    found += ways.size();
  }
  EXPECT_GT(found, 5U);
}

TEST(RefractedWays, BoxHasSixPlanes) {
  const Shape box = refine(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1)), 0.2);
  EXPECT_TRUE(RefractingSurface(box, ior).quick());
  // Straight above, the way is straight; the other planes do not face the light.
  const auto ways = ways_to(box, Vec3(0.1, 0.2, 0.3), {Vec3(0.1, 0.2, 5.0), false});
  ASSERT_EQ(ways.size(), 1U);
  EXPECT_NEAR((ways[0].crossing - Vec3(0.1, 0.2, 1.0)).norm(), 0.0, 1e-12);
  // Seen from inside the lamp is ior times as far from the surface: 1 / (4 + 0.7 / ior)^2.
  EXPECT_NEAR(ways[0].gain, 1.0 / std::pow(4.0 + 0.7 / ior, 2), 1e-12);
}

}  // namespace
}  // namespace knotlight
