#include "core/mesh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/rng.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::icosphere;

// Sums of some 1e4 terms of order one lose a few hundred roundings.
constexpr double rounding = 1e-12;

Vec3 random_vec3(Rng& rng) {
  const double x = rng.uniform();
  const double y = rng.uniform();
  return 2.0 * Vec3(x, y, rng.uniform()) - Vec3::Ones();
}

TEST(Mesh, BoxHasItsMeasures) {
  const TriangleMesh box = box_mesh({-1, 2, 0}, {1, 5, 0.5});
  EXPECT_NEAR(surface_area(box), 2.0 * (2 * 3 + 3 * 0.5 + 0.5 * 2), rounding);
  EXPECT_NEAR(signed_volume(box), 2 * 3 * 0.5, rounding);
  EXPECT_EQ(box.triangles.size(), 12U);
  EXPECT_EQ(test::open_edges(box), 0U);
  EXPECT_EQ(bounds(box).lo, Vec3(-1, 2, 0));
  EXPECT_EQ(bounds(box).hi, Vec3(1, 5, 0.5));
  for (std::size_t t = 0; t < 12; ++t)
    EXPECT_GT(box.normal(t).dot(box.corner(t, 0) - bounds(box).center()), 0.2);
}

// Colours linear in the position stay so.
TEST(Mesh, RefiningInterpolatesColours) {
  TriangleMesh quad = quad_mesh(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const auto colour = [](const Vec3& v) { return Spectrum(0.5 + 0.5 * v.x(), 0.25 * v.y(), 1.0); };
  for (const Vec3& v : quad.vertices) quad.colours.push_back(colour(v));
  const TriangleMesh fine = refine(quad, 0.1);
  ASSERT_EQ(fine.colours.size(), fine.vertices.size());
  EXPECT_GT(fine.vertices.size(), 400U);
  for (std::size_t i = 0; i < fine.vertices.size(); ++i)
    EXPECT_TRUE((fine.colours[i] - colour(fine.vertices[i])).abs().maxCoeff() < rounding);
}

TEST(Mesh, QuadFacesUCrossV) {
  const TriangleMesh quad = quad_mesh({1, 2, 3}, {2, 0, 0}, {0, 0, 0.5});
  EXPECT_NEAR(surface_area(quad), 4.0 * 2.0 * 0.5, rounding);
  for (const std::size_t t : {0U, 1U}) EXPECT_NEAR(quad.normal(t).y(), -1.0, rounding);
}

// Closed form: a torus of n x m vertices on the true surface tends to 2 pi^2 R r^2 and 4 pi^2 R r
// with error O(1/n^2 + 1/m^2): a quarter for twice the vertices.
TEST(Mesh, TorusTendsToPappus) {
  const double volume = 2.0 * pi * pi * 0.3 * 0.3;
  const double area = 4.0 * pi * pi * 0.3;
  const TriangleMesh coarse = test::torus_mesh(1.0, 0.3, 60, 20);
  const TriangleMesh fine = test::torus_mesh(1.0, 0.3, 120, 40);
  const double volume_rate = (volume - signed_volume(coarse)) / (volume - signed_volume(fine));
  const double area_rate = (area - surface_area(coarse)) / (area - surface_area(fine));
  EXPECT_NEAR(volume_rate, 4.0, 0.05);
  EXPECT_NEAR(area_rate, 4.0, 0.05);
  EXPECT_NEAR(signed_volume(fine), volume, 0.01 * volume);
}

TEST(Mesh, VolumeKeepsItsDigitsFarFromTheOrigin) {
  const Vec3 far_away(1e6, -2e6, 3e6);
  const double here = signed_volume(icosphere(2));
  // Coordinates of 3e6 are rounded to 5e-10; an apex at the origin would err by 1e3 and more.
  EXPECT_NEAR(signed_volume(test::moved(icosphere(2), far_away)), here, 1e-8);
  EXPECT_NEAR(signed_volume(test::turned_inside_out(icosphere(2))), -here, rounding);
}

// Nearest of a fine barycentric grid: never nearer than the result, and close to it.
TEST(NearestPoint, AgreesWithBruteForce) {
  Rng rng(1, Stream::tests, 0);
  constexpr int grid = 60;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 a = random_vec3(rng);
    const Vec3 b = random_vec3(rng);
    const Vec3 c = random_vec3(rng);
    const Vec3 p = 2.0 * random_vec3(rng);
    const Vec3 nearest = nearest_point_on_triangle(p, a, b, c);
    double least = 1e300;
    double distance_to_result = 1e300;
    for (int i = 0; i <= grid; ++i) {
      for (int j = 0; i + j <= grid; ++j) {
        const Vec3 q =
            a + static_cast<double>(i) / grid * (b - a) + static_cast<double>(j) / grid * (c - a);
        least = std::min(least, (p - q).norm());
        distance_to_result = std::min(distance_to_result, (nearest - q).norm());
      }
    }
    const double cell = ((b - a).norm() + (c - a).norm()) / grid;
    EXPECT_LE((p - nearest).norm(), least + rounding);
    EXPECT_LE(distance_to_result, cell);  // it is on the triangle
  }
}

TEST(NearestPoint, EveryRegionOfTheTriangle) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(2, 0, 0);
  const Vec3 c(0, 2, 0);
  const auto nearest = [&](double x, double y) {
    return nearest_point_on_triangle({x, y, 0.7}, a, b, c);
  };
  EXPECT_EQ(nearest(-1, -1), a);
  EXPECT_EQ(nearest(4, -1), b);
  EXPECT_EQ(nearest(-1, 4), c);
  EXPECT_EQ(nearest(0.5, -1), Vec3(0.5, 0, 0));
  EXPECT_EQ(nearest(-1, 0.5), Vec3(0, 0.5, 0));
  EXPECT_EQ(nearest(2, 2), Vec3(1, 1, 0));
  EXPECT_NEAR((nearest(0.5, 0.25) - Vec3(0.5, 0.25, 0)).norm(), 0.0, rounding);
}

TEST(SmoothNormals, FollowASphere) {
  const TriangleMesh sphere = icosphere(4);
  const std::vector<Vec3> normals = smooth_corner_normals(sphere, 0.5);
  ASSERT_EQ(normals.size(), 3 * sphere.triangles.size());
  for (std::size_t c = 0; c < normals.size(); ++c) {
    const Vec3& true_normal = sphere.corner(c / 3, static_cast<int>(c % 3));
    EXPECT_NEAR(normals[c].norm(), 1.0, rounding);
    // Facets are tilted by 1/30; the weighted average is better by an order of magnitude.
    EXPECT_LT((normals[c] - true_normal).norm(), 3e-3);
  }
}

TEST(SmoothNormals, KeepTheEdgesOfABoxSharp) {
  const TriangleMesh box = refine(box_mesh({0, 0, 0}, {1, 1, 1}), 0.4);
  const std::vector<Vec3> normals = smooth_corner_normals(box, 0.5);
  for (std::size_t c = 0; c < normals.size(); ++c)
    EXPECT_LT((normals[c] - box.normal(c / 3)).norm(), rounding);
}

// Without creases, a corner of a cube is shared evenly by its three faces, however these are cut
// into triangles: that is what weighting by angle is for.
TEST(SmoothNormals, WeightByAngleNotByTriangle) {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  const std::vector<Vec3> normals = smooth_corner_normals(box, -2.0);
  for (std::size_t c = 0; c < normals.size(); ++c) {
    const Vec3 diagonal = box.corner(c / 3, static_cast<int>(c % 3)).normalized();
    EXPECT_LT((normals[c] - diagonal).norm(), rounding);
  }
}

// Area and volume stay, for refinement adds no shape; every edge is short; the border stays shut.
void expect_refined(const TriangleMesh& mesh, double max_edge) {
  const TriangleMesh fine = refine(mesh, max_edge);
  EXPECT_LE(test::longest_edge(fine), max_edge);
  EXPECT_NEAR(surface_area(fine), surface_area(mesh), rounding * surface_area(mesh));
  EXPECT_NEAR(signed_volume(fine), signed_volume(mesh), rounding * surface_area(mesh));
  // A vertex left hanging on a neighbour's edge would lengthen the border.
  EXPECT_NEAR(test::length_of_open_edges(fine), test::length_of_open_edges(mesh), rounding);
  for (std::size_t t = 0; t < fine.triangles.size(); ++t) ASSERT_GT(fine.area(t), 0.0);
}

TEST(Refine, KeepsTheSurface) {
  expect_refined(box_mesh({0, 0, 0}, {2, 1, 0.25}), 0.05);
  expect_refined(icosphere(1), 0.13);
  expect_refined(test::torus_mesh(1.0, 0.3, 9, 30), 0.11);
  expect_refined(quad_mesh({0, 0, 0}, {1, 0.2, 0}, {0, 1, 0}), 0.1);
}

// Triangles with one, two and three long edges, and needles, whose cuts take turns.
TEST(Refine, CutsEveryShapeOfTriangle) {
  Rng rng(2, Stream::tests, 0);
  for (int trial = 0; trial < 200; ++trial) {
    const double flatness = std::pow(10.0, -4.0 * rng.uniform());
    const Vec3 far_corner(rng.uniform(), flatness, 0.0);
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, far_corner, {0.5, -flatness, 0.0}},
                      {{0, 1, 2}, {1, 0, 3}}};
    expect_refined(mesh, 0.02 + 0.5 * rng.uniform());
  }
}

TEST(Refine, LeavesShortEdgesAlone) {
  const TriangleMesh sphere = icosphere(2);
  const TriangleMesh same = refine(sphere, test::longest_edge(sphere));
  EXPECT_EQ(same.vertices.size(), sphere.vertices.size());
  EXPECT_EQ(same.triangles, sphere.triangles);
}

// Edges near the rounding of the coordinates have no midpoints; asking for shorter ones must end.
TEST(Refine, EndsAtTheRoundingOfCoordinates) {
  const Vec3 lo(1e9, 1e9, 1e9);
  const TriangleMesh fine = refine(box_mesh(lo, lo + Vec3::Constant(1e-5)), 1e-12);
  EXPECT_EQ(test::open_edges(fine), 0U);
}

}  // namespace
}  // namespace knotlight
