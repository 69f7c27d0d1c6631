#include "pipeline/residual_effect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "core/shape.h"
#include "pipeline/sample_points.h"
#include "reference/legendre.h"

namespace knotlight {
namespace {

constexpr std::size_t count = 2048;

Points points_on_sphere() {
  return columns(stratified_surface_points(Sphere{}, count, true, 1, Stream::tests)).positions;
}

// In the unit ball with lambda = 0 the residual P_l leaves the error r^l P_l / (1 + k l). The plane
// that stands for the surface there has the wave number sqrt(l (l + 1)) for l, and points are
// finite in number: within 25 % and the two standard errors added.
TEST(ResidualEffect, OfSphericalHarmonics) {
  const Points x = points_on_sphere();
  const Workers workers(2);
  for (const double k : {0.03, 0.1, 0.3})
    for (const int l : {0, 1, 3, 8, 16}) {
      Eigen::VectorXd residual(x.cols());
      for (Eigen::Index i = 0; i < x.cols(); ++i)
        residual[i] = legendre_polynomials(l, x(2, i))[static_cast<std::size_t>(l)];
      const double all = residual.squaredNorm() / count;
      const double found = std::sqrt(mean_square_effect(x, {residual, residual}, k, workers) / all);
      const double exact = 1.0 / (1.0 + k * l);
      RecordProperty(std::to_string(k) + " " + std::to_string(l),
                     std::to_string(found) + " " + std::to_string(exact));
      EXPECT_GT(found, 0.85 * exact) << k << " " << l;
      EXPECT_LT(found, 1.25 * exact) << k << " " << l;
    }
}

// A residual without order between the points, as of facets smaller than k: hardly anything is
// left, and what is reported is the standard error alone. Noise that the samples do not share is
// none of it.
TEST(ResidualEffect, OfDisorderIsSmall) {
  const Points x = points_on_sphere();
  Rng rng(2, Stream::tests, 0);
  std::array<Eigen::VectorXd, 2> noise;
  for (Eigen::VectorXd& half : noise) {
    half.resize(x.cols());
    for (double& v : half) v = rng.uniform() - 0.5;
  }
  const Workers workers(2);
  const double all = noise[0].squaredNorm() / count;
  EXPECT_LT(mean_square_effect(x, {noise[0], noise[0]}, 0.3, workers), 0.02 * all);
  EXPECT_LT(mean_square_effect(x, noise, 0.03, workers), 0.1 * all);
}

// Never more than the bound of the maximum principle, and nothing from nothing.
TEST(ResidualEffect, Bounds) {
  const Points x = points_on_sphere();
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(x.cols());
  const Workers workers(1);
  EXPECT_EQ(mean_square_effect(x, {one, one}, 1e-4, workers), 1.0);
  EXPECT_EQ(mean_square_effect(x, {0.0 * one, 0.0 * one}, 0.1, workers), 0.0);
  EXPECT_EQ(mean_square_effect(x.leftCols(1), {one.head(1), one.head(1)}, 0.1, workers), 0.0);
  Eigen::VectorXd bad = one;
  bad[7] = std::nan("");
  EXPECT_TRUE(std::isnan(mean_square_effect(x, {bad, bad}, 0.1, workers)));
}

}  // namespace
}  // namespace knotlight
