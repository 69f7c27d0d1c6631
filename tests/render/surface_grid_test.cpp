#include "render/surface_grid.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

double smooth_field(const Vec3& p) {
  return std::sin(p.x()) * std::cos(2.0 * p.y()) + p.z();
}

double largest_error(const SurfaceGrid& grid, const RayCaster& caster, const Vec3& center) {
  Eigen::VectorXd values(grid.nodes().cols());
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = smooth_field(grid.nodes().col(i));
  Rng rng(1, Stream::tests, 0);
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double u = rng.uniform();
    const auto hit = caster.nearest({center, sample_sphere(u, rng.uniform())});
    worst = std::max(worst, std::abs(grid.interpolate(values, *hit) - smooth_field(hit->position)));
  }
  return worst;
}

// Bilinear interpolation: the error falls with the square of the cell size, on every cube face and
// across their edges.
TEST(SurfaceGrid, SphereInterpolatesAtSecondOrder) {
  const Vec3 center(1.0, -2.0, 0.5);
  const Shape shape = Sphere{center, 1.5};
  const RayCaster caster({&shape});
  const double coarse = largest_error(SurfaceGrid(shape, 16), caster, center);
  const double fine = largest_error(SurfaceGrid(shape, 32), caster, center);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, coarse / 3.0);
}

TEST(SurfaceGrid, NodesLieOnTheSphere) {
  const Shape shape = Sphere{Vec3(1, 2, 3), 0.5};
  const SurfaceGrid grid(shape, 8);
  EXPECT_EQ(grid.nodes().cols(), 6 * 81);
  for (Eigen::Index i = 0; i < grid.nodes().cols(); ++i)
    EXPECT_NEAR((grid.nodes().col(i) - Vec3(1, 2, 3)).norm(), 0.5, 1e-15);
}

TEST(SurfaceGrid, MeshInterpolatesBetweenVerticesAtSecondOrder) {
  const TriangleMesh box = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const Shape coarse = refine(box, 0.4);
  const Shape fine = refine(box, 0.2);
  const RayCaster coarse_caster({&coarse});
  const RayCaster fine_caster({&fine});
  const double coarse_error = largest_error(SurfaceGrid(coarse), coarse_caster, Vec3(0.1, 0, 0));
  const double fine_error = largest_error(SurfaceGrid(fine), fine_caster, Vec3(0.1, 0, 0));
  EXPECT_LT(fine_error, coarse_error / 3.0);
}

}  // namespace
}  // namespace knotlight
