#include "trace/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-12;  // of lengths of order 1 after some ten operations in double

// A latitude-longitude mesh of the unit sphere; only for comparing rays with brute force.
TriangleMesh globe(const Vec3& center, double radius, int rows, int columns) {
  TriangleMesh mesh;
  mesh.vertices.push_back(center + Vec3(0, 0, radius));
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double theta = pi * i / rows;
      const double phi = 2.0 * pi * j / columns;
      mesh.vertices.push_back(center + radius * Vec3(std::sin(theta) * std::cos(phi),
                                                     std::sin(theta) * std::sin(phi),
                                                     std::cos(theta)));
    }
  mesh.vertices.push_back(center - Vec3(0, 0, radius));
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(1 + (i - 1) * columns + j % columns);
  };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int j = 0; j < columns; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rows - 1, j + 1), at(rows - 1, j)});
    for (int i = 1; i + 1 < rows; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// Moeller-Trumbore over all triangles in double: the oracle.
std::optional<std::pair<double, std::uint32_t>> brute_force(const Ray& ray,
                                                            const TriangleMesh& mesh) {
  std::optional<std::pair<double, std::uint32_t>> best;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 e1 = mesh.corner(i, 1) - mesh.corner(i, 0);
    const Vec3 e2 = mesh.corner(i, 2) - mesh.corner(i, 0);
    const Vec3 p = ray.direction.cross(e2);
    const double det = e1.dot(p);
    const Vec3 s = ray.origin - mesh.corner(i, 0);
    const double b1 = s.dot(p) / det;
    const Vec3 q = s.cross(e1);
    const double b2 = ray.direction.dot(q) / det;
    const double t = e2.dot(q) / det;
    if (b1 < 0.0 || b2 < 0.0 || b1 + b2 > 1.0 || t < 1e-6 || t > ray.t_max) continue;
    if (!best || t < best->first) best = {t, static_cast<std::uint32_t>(i)};
  }
  return best;
}

Vec3 random_point(Rng& rng, double size) {
  const double x = rng.uniform();
  const double y = rng.uniform();
  return size * (2.0 * Vec3(x, y, rng.uniform()) - Vec3::Ones());
}

Vec3 random_direction(Rng& rng) {
  const double u = rng.uniform();
  return sample_sphere(u, rng.uniform());
}

TEST(RayCaster, NearestHitMatchesBruteForce) {
  const Shape shape = globe(Vec3(0.1, 0.2, -0.3), 1.0, 24, 32);
  const auto& mesh = std::get<TriangleMesh>(shape);
  const RayCaster caster({&shape});
  Rng rng(1, Stream::tests, 0);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray{random_point(rng, 2.0), random_direction(rng)};
    const auto expected = brute_force(ray, mesh);
    const auto hit = caster.nearest(ray);
    ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
    EXPECT_EQ(caster.occluded(ray), expected.has_value());
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->t, expected->first, 1e-9) << i;  // at an edge either triangle may answer
    EXPECT_NEAR((hit->position - (ray.origin + hit->t * ray.direction)).norm(), 0.0, 1e-9);
  }
  EXPECT_GT(hits, 300);
}

// Embree works in float (7 digits); points and normals handed on must be good to double, also far
// from the origin.
TEST(RayCaster, HitsLieOnTheSurfaceToDoublePrecision) {
  const Vec3 far_away(1000.0, -2000.0, 500.0);
  const Shape mesh_shape = globe(far_away, 1.0, 24, 32);
  const Shape sphere_shape = Sphere{far_away + Vec3(3, 0, 0), 1.0};
  const auto& mesh = std::get<TriangleMesh>(mesh_shape);
  const RayCaster caster({&mesh_shape, &sphere_shape});
  Rng rng(2, Stream::tests, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 inside_mesh = far_away + random_point(rng, 0.4);
    const auto hit = caster.nearest({inside_mesh, random_direction(rng)}, 0);
    ASSERT_TRUE(hit);
    const double off_plane = (hit->position - mesh.corner(hit->primitive, 0)).dot(hit->normal);
    EXPECT_NEAR(off_plane, 0.0, rounding * 1000.0);  // coordinates are of order 1000
    const auto ball = caster.nearest({far_away + Vec3(3, 0, 0), random_direction(rng)}, 1);
    ASSERT_TRUE(ball);
    EXPECT_NEAR(ball->t, 1.0, rounding * 1000.0);
    EXPECT_NEAR((ball->position - far_away - Vec3(3, 0, 0)).norm(), 1.0, rounding * 1000.0);
  }
}

// A ray that starts on a surface leaves it, at any angle down to 1e-4.
TEST(RayCaster, DoesNotMeetTheSurfaceItStartsFrom) {
  const Shape box = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const Shape ball = Sphere{Vec3(5, 0, 0), 1.0};
  const RayCaster caster({&box, &ball});
  Rng rng(3, Stream::tests, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 start(random_point(rng, 0.99).x(), random_point(rng, 0.99).y(), 1.0);
    const double slope = std::pow(10.0, -4.0 * rng.uniform());
    const double phi = 2.0 * pi * rng.uniform();
    const Vec3 along(std::cos(phi), std::sin(phi), 0.0);
    EXPECT_FALSE(caster.nearest({start, (along + slope * Vec3::UnitZ()).normalized()}, 0));
    EXPECT_TRUE(caster.nearest({start, (along - slope * Vec3::UnitZ()).normalized()}, 0));
    const Vec3 n = random_direction(rng);
    const Vec3 on_ball = Vec3(5, 0, 0) + n;
    const Vec3 out = (Frame(n).t + slope * n).normalized();
    EXPECT_FALSE(caster.nearest({on_ball, out}, 1));
    EXPECT_TRUE(caster.nearest({on_ball, reflect(out, n)}, 1));
  }
}

TEST(RayCaster, InsideOfMeshAndSphere) {
  const Shape mesh = globe(Vec3::Zero(), 1.0, 48, 64);
  const Shape ball = Sphere{Vec3::Zero(), 1.0};
  const RayCaster caster({&mesh, &ball});
  Rng rng(4, Stream::tests, 0);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random_point(rng, 1.2);
    if (std::abs(p.norm() - 1.0) < 0.01) continue;  // between the mesh and the sphere it stands for
    EXPECT_EQ(caster.inside(p, 0), p.norm() < 1.0);
    EXPECT_EQ(caster.inside(p, 1), p.norm() < 1.0);
  }
}

// A box has diagonal edges where symmetric rays meet two triangles at once.
TEST(RayCaster, CentresAndSymmetryPlanesAreInside) {
  const Shape box = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const RayCaster caster({&box});
  EXPECT_TRUE(caster.inside(Vec3::Zero(), 0));
  EXPECT_TRUE(caster.inside(Vec3(0.5, 0.5, 0.5), 0));
  EXPECT_FALSE(caster.inside(Vec3(1.5, 1.5, 1.5), 0));
  EXPECT_NEAR(caster.path_length_inside({Vec3(-3, 0, 0), Vec3::UnitX()}, 0), 2.0, rounding);
  const Vec3 diagonal = Vec3::Ones().normalized();
  EXPECT_NEAR(caster.path_length_inside({-2.0 * Vec3::Ones(), diagonal}, 0), 2.0 * std::sqrt(3.0),
              1e-6);
}

// Closed form for the sphere: chord 2 sqrt(1 - b^2) at impact parameter b.
TEST(RayCaster, PathLengthIsTheChord) {
  const Shape ball = Sphere{Vec3(1, 2, 3), 1.0};
  const Shape mesh = globe(Vec3(1, 2, 3), 1.0, 200, 300);
  const RayCaster caster({&ball, &mesh});
  for (const double b : {0.0, 0.3, 0.7, 0.95}) {
    const Ray ray{Vec3(1 + b, 2 + 0.01, -5), Vec3::UnitZ()};
    const double chord = 2.0 * std::sqrt(1.0 - b * b - 0.0001);
    EXPECT_NEAR(caster.path_length_inside(ray, 0), chord, rounding);
    EXPECT_NEAR(caster.path_length_inside(ray, 1), chord, 1e-3);
    EXPECT_NEAR(caster.path_length_inside({ray.origin, ray.direction, 8.0}, 0), 0.5 * chord,
                rounding);
    EXPECT_NEAR(caster.path_length_inside({Vec3(1 + b, 2.01, 3), Vec3::UnitZ()}, 0), 0.5 * chord,
                rounding);
  }
}

// Two overlapping closed parts of one mesh count as one inside.
TEST(RayCaster, OverlappingPartsAreOneSolid) {
  TriangleMesh two = box_mesh(Vec3(0, 0, 0), Vec3(2, 1, 1));
  const TriangleMesh second = box_mesh(Vec3(1, 0.1, 0.1), Vec3(3, 0.9, 0.9));
  const auto offset = static_cast<std::uint32_t>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const Triangle& t : second.triangles)
    two.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  const Shape shape = two;
  const RayCaster caster({&shape});
  EXPECT_NEAR(caster.path_length_inside({Vec3(-1, 0.45, 0.55), Vec3::UnitX()}, 0), 3.0, rounding);
  EXPECT_TRUE(caster.inside(Vec3(1.5, 0.5, 0.5), 0));
  EXPECT_EQ(caster.crossings({Vec3(-1, 0.45, 0.55), Vec3::UnitX()}, 0).size(), 2U);
}

TEST(RayCaster, NearestSurfacePointMatchesBruteForce) {
  const Shape shape = globe(Vec3::Zero(), 1.0, 24, 32);
  const Shape ball = Sphere{Vec3(0, 0, 4), 0.5};
  const auto& mesh = std::get<TriangleMesh>(shape);
  const RayCaster caster({&shape, &ball});
  Rng rng(5, Stream::tests, 0);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(rng, 1.5);
    double best = 1e300;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      best = std::min(best, (p - nearest_point_on_triangle(p, mesh.corner(t, 0), mesh.corner(t, 1),
                                                           mesh.corner(t, 2)))
                                .norm());
    const SurfacePoint nearest = caster.nearest_surface_point(p, 0);
    EXPECT_NEAR((nearest.position - p).norm(), best, rounding);
    EXPECT_NEAR(nearest.normal.norm(), 1.0, rounding);
    const NearestPoint found = *caster.nearest_point(p, 0, best * 1.001);
    EXPECT_NEAR(found.distance, best, rounding);
    EXPECT_EQ(found.surface.normal, mesh.normal(found.primitive));
    EXPECT_FALSE(caster.nearest_point(p, 0, best * 0.999).has_value());
    const SurfacePoint on_ball = caster.nearest_surface_point(p, 1);
    EXPECT_NEAR((on_ball.position - p).norm(), std::abs((p - Vec3(0, 0, 4)).norm() - 0.5),
                rounding);
    const double gap = (on_ball.position - p).norm();
    EXPECT_NEAR(caster.nearest_point(p, 1, gap * 1.001)->distance, gap, rounding);
    EXPECT_FALSE(caster.nearest_point(p, 1, gap * 0.999).has_value());
  }
}

TEST(RayCaster, OccludedBetweenTwoPoints) {
  const Shape ball = Sphere{Vec3::Zero(), 1.0};
  const Shape plate = quad_mesh(Vec3(0, 0, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const RayCaster caster({&ball, &plate});
  EXPECT_TRUE(caster.occluded(Vec3(0.1, 0.1, 5), Vec3(0.1, 0.1, 1.5)));
  EXPECT_FALSE(caster.occluded(Vec3(0.1, 0.1, 5), Vec3(0.1, 0.1, 2.5)));
  EXPECT_FALSE(caster.occluded(Vec3(0.1, 0.1, 5), Vec3(0.1, 0.1, 2.0)));  // ends on the plate
  EXPECT_TRUE(caster.occluded(Vec3(-3, 0, 0), Vec3(3, 0, 0)));
}

TEST(RayCaster, EmptyScene) {
  const RayCaster caster({});
  EXPECT_FALSE(caster.nearest({Vec3::Zero(), Vec3::UnitX()}));
}

}  // namespace
}  // namespace knotlight
