#include "core/shape.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/statistics.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::z_one_in_a_million;

constexpr double rounding = 1e-12;

const Sphere ball{{1.0, -2.0, 0.5}, 3.0};

bool same_bits(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].position != b[i].position || a[i].normal != b[i].normal) return false;
  return true;
}

std::vector<SurfacePoint> points_on(const Shape& shape, std::size_t count, bool jitter,
                                    std::uint64_t seed = 1) {
  return stratified_surface_points(shape, count, jitter, seed, Stream::tests);
}

TEST(Shape, SphereHasItsMeasures) {
  const Shape shape = ball;
  EXPECT_NEAR(surface_area(shape), 36.0 * pi, rounding * 36.0 * pi);
  EXPECT_NEAR(volume(shape), 36.0 * pi, rounding * 36.0 * pi);
  EXPECT_EQ(bounds(shape).lo, Vec3(-2.0, -5.0, -2.5));
  EXPECT_EQ(bounds(shape).hi, Vec3(4.0, 1.0, 3.5));
}

TEST(Shape, MeshHasItsMeasures) {
  const Shape shape = box_mesh({0, 0, 0}, {1, 2, 3});
  EXPECT_NEAR(surface_area(shape), 22.0, rounding * 22.0);
  EXPECT_NEAR(volume(shape), 6.0, rounding * 6.0);
  EXPECT_EQ(bounds(shape).hi, Vec3(1, 2, 3));
}

TEST(SurfacePoints, AreAsManyAsAskedFor) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 100U, 1009U}) {
    for (const bool jitter : {false, true}) {
      EXPECT_EQ(points_on(ball, count, jitter).size(), count);
      EXPECT_EQ(points_on(box, count, jitter).size(), count);
    }
  }
}

TEST(SurfacePoints, LieOnTheSphereAndFaceOut) {
  for (const bool jitter : {false, true}) {
    for (const SurfacePoint& p : points_on(ball, 500, jitter)) {
      EXPECT_NEAR((p.position - ball.center).norm(), ball.radius, rounding);
      EXPECT_NEAR((p.position - ball.center - ball.radius * p.normal).norm(), 0.0, rounding);
      EXPECT_NEAR(p.normal.norm(), 1.0, rounding);
    }
  }
}

TEST(SurfacePoints, LieOnTheMeshAndFaceOut) {
  const TriangleMesh torus = test::torus_mesh(1.0, 0.4, 30, 16);
  for (const bool jitter : {false, true}) {
    for (const SurfacePoint& p : points_on(torus, 300, jitter)) {
      bool lies_on_its_facet = false;
      for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
        const Vec3 nearest = nearest_point_on_triangle(p.position, torus.corner(t, 0),
                                                       torus.corner(t, 1), torus.corner(t, 2));
        lies_on_its_facet |= (p.position - nearest).norm() < rounding &&
                             (p.normal - torus.normal(t)).norm() < rounding;
      }
      EXPECT_TRUE(lies_on_its_facet);
      const Vec3 ring = Vec3(p.position.x(), p.position.y(), 0.0).normalized();
      EXPECT_GT(p.normal.dot(p.position - ring), 0.0);
    }
  }
}

TEST(SurfacePoints, RepeatToTheLastBit) {
  for (const Shape& shape : {Shape(ball), Shape(test::icosphere(2))}) {
    EXPECT_TRUE(same_bits(points_on(shape, 400, true, 5), points_on(shape, 400, true, 5)));
    EXPECT_FALSE(same_bits(points_on(shape, 400, true, 5), points_on(shape, 400, true, 6)));
    EXPECT_TRUE(same_bits(points_on(shape, 400, false, 5), points_on(shape, 400, false, 6)));
  }
}

// Each stratum holds one point, so its bands of z do: with n points, the k-th smallest z lies in
// the band of the k-th stratum's row. Summed up: the number of points below z differs from the
// exact n (z + 1) / 2 by less than one row, with and without jitter.
TEST(SurfacePoints, SphereStrataHaveEqualAreas) {
  constexpr std::size_t n = 1000;
  const double row = std::sqrt(2.0 * n) + 2.0;
  for (const bool jitter : {false, true}) {
    const auto points = points_on(Sphere{}, n, jitter);
    for (double z = -0.95; z < 1.0; z += 0.1) {
      double below = 0.0;
      for (const SurfacePoint& p : points) below += p.position.z() < z ? 1.0 : 0.0;
      EXPECT_LT(std::abs(below - n * (z + 1.0) / 2.0), row);
    }
  }
}

// Chi-square against equal areas. Stratification only lowers the statistic, so the false-alarm rate
// is below the one in a million of independent points. 60 000 points in sets with seeds of their
// own; on the sphere 3000 sets of 20 (3 bands) in 8 x 16 cells equal in (z, phi), on the box 300
// sets of 200 in 6 faces x 4 x 4 squares.
TEST(SurfacePoints, JitteredPointsAreUniformOnTheSphere) {
  constexpr int rows = 8;
  constexpr int columns = 16;
  std::vector<double> counts(rows * columns, 0.0);
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    for (const SurfacePoint& p : points_on(Sphere{}, 20, true, seed)) {
      const double phi = std::atan2(p.position.y(), p.position.x()) + pi;
      const int row = std::min(rows - 1, static_cast<int>(0.5 * rows * (p.position.z() + 1.0)));
      const int column = std::min(columns - 1, static_cast<int>(columns * phi / (2.0 * pi)));
      counts[static_cast<std::size_t>(row * columns + column)] += 1.0;
    }
  }
  const std::vector<double> expected(counts.size(), 3000.0 * 20.0 / (rows * columns));
  EXPECT_LT(test::chi_square_z(counts, expected), z_one_in_a_million);
}

TEST(SurfacePoints, JitteredPointsAreUniformOnAMesh) {
  constexpr int cells = 4;
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  std::vector<double> counts(6 * cells * cells, 0.0);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    for (const SurfacePoint& p : points_on(box, 200, true, seed)) {
      Eigen::Index axis = 0;
      p.normal.cwiseAbs().maxCoeff(&axis);
      const auto cell = [&](Eigen::Index offset) {
        return std::min(cells - 1, static_cast<int>(cells * p.position[(axis + offset) % 3]));
      };
      const int face = 2 * static_cast<int>(axis) + (p.normal[axis] > 0.0 ? 1 : 0);
      counts[static_cast<std::size_t>((face * cells + cell(1)) * cells + cell(2))] += 1.0;
    }
  }
  const std::vector<double> expected(counts.size(), 300.0 * 200.0 / (6 * cells * cells));
  EXPECT_LT(test::chi_square_z(counts, expected), z_one_in_a_million);
}

// Every face of a box of unequal sides gets its share to within the strata cut by its border; each
// of the 8 octants of a sphere mesh too. Random points would stray by sqrt(n) = 63.
TEST(SurfacePoints, MeshStrataFollowTheArea) {
  constexpr std::size_t n = 4000;
  const TriangleMesh box = refine(box_mesh({0, 0, 0}, {1, 2, 3}), 0.2);
  const Vec3 face_area(6.0, 3.0, 2.0);
  for (const bool jitter : {false, true}) {
    Vec3 lower = Vec3::Zero();
    Vec3 upper = Vec3::Zero();
    for (const SurfacePoint& p : points_on(box, n, jitter)) {
      Eigen::Index axis = 0;
      p.normal.cwiseAbs().maxCoeff(&axis);
      (p.normal[axis] > 0.0 ? upper : lower)[axis] += 1.0;
    }
    const Vec3 share = static_cast<double>(n) * face_area / 22.0;
    EXPECT_LT((lower - share).cwiseAbs().maxCoeff(), 40.0) << lower.transpose();
    EXPECT_LT((upper - share).cwiseAbs().maxCoeff(), 40.0) << upper.transpose();
  }
}

// Many strata in one triangle: centres must fill it, not line up. The largest empty disc around
// the cells of a 20 x 20 grid stays below three mean spacings.
TEST(SurfacePoints, CentresFillALargeTriangle) {
  const TriangleMesh quad = quad_mesh({0.5, 0.5, 0}, {0.5, 0, 0}, {0, 0.5, 0});
  constexpr std::size_t n = 400;
  const auto points = points_on(quad, n, false);
  double largest_gap = 0.0;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const Vec3 probe((i + 0.5) / 20.0, (j + 0.5) / 20.0, 0.0);
      double nearest = 1e300;
      for (const SurfacePoint& p : points) nearest = std::min(nearest, (p.position - probe).norm());
      largest_gap = std::max(largest_gap, nearest);
    }
  }
  EXPECT_LT(largest_gap, 3.0 / std::sqrt(static_cast<double>(n)));
}

}  // namespace
}  // namespace knotlight
