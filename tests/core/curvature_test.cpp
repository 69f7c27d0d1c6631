#include "core/curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/test_meshes.h"

namespace knotlight {
namespace {

using std::numbers::pi;

TEST(SurfaceCurvature, OfASphereIsOneOverItsRadius) {
  const SurfaceCurvature exact(Sphere{Vec3::Zero(), 2.5}, 0.1);
  EXPECT_EQ(exact.median(), 0.4);
  EXPECT_EQ(exact.at(0), 0.4);
}

// Tube of radius r about a ring of radius R: H = (1/r + cos v / (R + r cos v)) / 2.
TEST(SurfaceCurvature, OfATorusIsItsFormula) {
  const double R = 2.0, r = 0.6;
  const Shape torus = test::torus_mesh(R, r, 120, 60);
  const auto& mesh = std::get<TriangleMesh>(torus);
  const SurfaceCurvature curvature(torus, 0.1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); t += 97) {
    const Vec3 p = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    const double from_axis = std::hypot(p.x(), p.y());
    const double cosine = (from_axis - R) / r;
    EXPECT_NEAR(curvature.at(t), 0.5 * (1.0 / r + cosine / from_axis), 0.03 / r) << t;
  }
}

// Flat but for its edges: the median is 0, and smoothing keeps the integral, length pi / 4 of the
// edges.
TEST(SurfaceCurvature, OfABoxSitsInItsEdges) {
  const Shape box = refine(box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 2)), 0.2);
  const auto& mesh = std::get<TriangleMesh>(box);
  const SurfaceCurvature curvature(box, 0.15);
  EXPECT_NEAR(curvature.median(), 0.0, 0.01);
  double integral = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    integral += curvature.at(t) * mesh.area(t);
  EXPECT_NEAR(integral, pi / 4.0 * (8.0 * 4.0 + 4.0 * 2.0), 0.02 * integral);
}

}  // namespace
}  // namespace knotlight
