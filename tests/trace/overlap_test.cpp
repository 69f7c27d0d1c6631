#include "trace/overlap.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

using test::icosphere;
using test::joined;
using test::moved;
using test::turned_inside_out;

// The complaint about two objects, "" if there is none. Both orders must agree.
std::string complaint(const Shape& a, const Shape& b, const Material& material) {
  std::string messages[2];
  for (const int first : {0, 1}) {
    Scene scene;
    scene.objects = {{"wax", first == 0 ? a : b, material}, {"soap", first == 0 ? b : a, material}};
    const RayCaster caster({&scene.objects[0].shape, &scene.objects[1].shape});
    try {
      refuse_overlaps(scene, caster);
    } catch (const InputError& error) {
      messages[first] = error.what();
    }
  }
  EXPECT_EQ(messages[0].empty(), messages[1].empty()) << messages[0] << messages[1];
  return messages[0];
}

bool overlap(const Shape& a, const Shape& b) {
  return !complaint(a, b, TranslucentMaterial{}).empty();
}

TriangleMesh box(const Vec3& lo, const Vec3& hi) {
  return refine(box_mesh(lo, hi), 0.3);
}

TEST(Overlap, NamesBothObjects) {
  const std::string message = complaint(Sphere{}, Sphere{{1, 0, 0}, 1.0}, TranslucentMaterial{});
  EXPECT_NE(message.find("'wax' and 'soap' overlap around ("), std::string::npos) << message;
}

TEST(Overlap, OnlyTranslucentObjectsMatter) {
  EXPECT_EQ(complaint(Sphere{}, Sphere{{1, 0, 0}, 1.0}, DiffuseMaterial{}), "");
}

TEST(Overlap, Spheres) {
  const Sphere unit{};
  EXPECT_FALSE(overlap(unit, Sphere{{3, 0, 0}, 1.0}));
  EXPECT_FALSE(overlap(unit, Sphere{{1.6, 0, 1.2}, 1.0}));    // touching: distance 2
  EXPECT_FALSE(overlap(unit, Sphere{{1.2, 1.2, 1.2}, 1.0}));  // boxes meet, balls do not
  EXPECT_TRUE(overlap(unit, Sphere{{1.59, 0, 1.2}, 1.0}));
  EXPECT_TRUE(overlap(unit, Sphere{{0.1, 0, 0}, 0.2}));  // nested
  EXPECT_TRUE(overlap(unit, unit));
}

TEST(Overlap, SphereAndMesh) {
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_FALSE(overlap(cube, Sphere{{3, 0, 0}, 1.0}));
  EXPECT_FALSE(overlap(cube, Sphere{{2, 0.1, 0.2}, 1.0}));    // rests on a face
  EXPECT_FALSE(overlap(cube, Sphere{{1.8, 1.8, 1.8}, 1.0}));  // beside a corner
  EXPECT_TRUE(overlap(cube, Sphere{{1.5, 1.5, 1.5}, 1.0}));
  EXPECT_TRUE(overlap(cube, Sphere{{1.99, 0.1, 0.2}, 1.0}));
  EXPECT_TRUE(overlap(cube, Sphere{{0.1, 0, 0}, 0.2}));   // ball in the cube
  EXPECT_TRUE(overlap(cube, Sphere{{0.1, 0, 0}, 10.0}));  // cube in the ball
}

TEST(Overlap, BoxesMayShareAFaceAnEdgeOrACorner) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(overlap(cube, box({2, 0, 0}, {3, 1, 1})));
  EXPECT_FALSE(overlap(cube, box({1, 0, 0}, {2, 1, 1})));
  EXPECT_FALSE(overlap(cube, box({1, 0.2, 0.3}, {2, 0.9, 4})));  // part of a face
  EXPECT_FALSE(overlap(cube, box({1, 1, 0}, {2, 2, 1})));
  EXPECT_FALSE(overlap(cube, box({1, 1, 1}, {2, 2, 2})));
  EXPECT_TRUE(overlap(cube, box({0.999, 0, 0}, {2, 1, 1})));
}

// No vertex of either box lies in the other: only edges go through.
TEST(Overlap, CrossingBars) {
  EXPECT_TRUE(
      overlap(box_mesh({-3, -1, -1}, {3, 1, 1}), box_mesh({-0.5, -0.5, -3}, {0.5, 0.5, 3})));
  EXPECT_FALSE(overlap(box_mesh({-3, -1, -1}, {3, 1, 1}), box_mesh({-0.5, 1.1, -3}, {0.5, 2, 3})));
}

TEST(Overlap, NestedAndEqualMeshes) {
  const TriangleMesh ball = icosphere(2);
  EXPECT_TRUE(overlap(ball, icosphere(1, {0.1, 0.2, 0.0}, 0.3)));
  EXPECT_TRUE(overlap(ball, ball));  // every vertex and edge of one lies on the other
}

TEST(Overlap, CavitiesAndHandlesAreFree) {
  const TriangleMesh hollow =
      joined(icosphere(2), turned_inside_out(icosphere(2, Vec3::Zero(), 0.5)));
  EXPECT_FALSE(overlap(hollow, icosphere(2, Vec3::Zero(), 0.4)));
  EXPECT_FALSE(overlap(hollow, Sphere{{0, 0, 0}, 0.4}));
  EXPECT_TRUE(overlap(hollow, icosphere(2, {0.2, 0, 0}, 0.4)));
  const TriangleMesh torus = test::torus_mesh(1.0, 0.3, 40, 20);
  EXPECT_FALSE(overlap(torus, Sphere{{0, 0, 0}, 0.6}));
  EXPECT_TRUE(overlap(torus, Sphere{{0, 0, 0}, 0.75}));
}

// Two links of a chain: boxes meet deeply, solids do not.
TEST(Overlap, LinkedRings) {
  const TriangleMesh ring = test::torus_mesh(1.0, 0.2, 40, 16);
  TriangleMesh link = ring;
  for (Vec3& v : link.vertices) v = Vec3(v.x() + 1.0, v.z(), -v.y());
  EXPECT_FALSE(overlap(ring, link));
  EXPECT_TRUE(overlap(ring, moved(link, {0.7, 0, 0})));
}

// Depth counts from a millionth of the smaller object's size.
TEST(Overlap, ToleranceIsAMillionthOfTheSmaller) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(overlap(cube, box({1.0 - 3e-7, 0.1, 0.1}, {2, 0.9, 0.9})));
  EXPECT_TRUE(overlap(cube, box({1.0 - 2e-5, 0.1, 0.1}, {2, 0.9, 0.9})));
  // Turned, so that the bounding boxes meet and the decision is left to the surfaces.
  const auto turned = [](TriangleMesh mesh) {
    const Eigen::AngleAxisd turn(0.5, Vec3(1, 2, 3).normalized());
    for (Vec3& v : mesh.vertices) v = turn * v;
    return mesh;
  };
  EXPECT_FALSE(overlap(turned(cube), turned(box({1.0 - 3e-7, 0.1, 0.1}, {2, 0.9, 0.9}))));
  EXPECT_TRUE(overlap(turned(cube), turned(box({1.0 - 2e-5, 0.1, 0.1}, {2, 0.9, 0.9}))));
  EXPECT_FALSE(overlap(Sphere{}, Sphere{{2.0 - 1e-6, 0, 0}, 1.0}));
  EXPECT_TRUE(overlap(Sphere{}, Sphere{{2.0 - 1e-5, 0, 0}, 1.0}));
}

}  // namespace
}  // namespace knotlight
