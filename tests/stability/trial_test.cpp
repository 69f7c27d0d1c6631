#include "stability/trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/medium.h"

namespace knotlight {
namespace {

constexpr double step = 1e-3;       // of differences; second ones are then right to 1e-5
constexpr double tolerance = 1e-4;  // of the largest second derivative, 10 to 100

double laplacian(const ExactField& u, const Vec3& x) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 h = step * Vec3::Unit(axis);
    sum += (u.value(x - h) - 2.0 * u.value(x) + u.value(x + h)) / (step * step);
  }
  return sum;
}

void check_gradient(const ExactField& u, const Vec3& x) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 h = step * Vec3::Unit(axis);
    EXPECT_NEAR(u.gradient(x)[axis], (u.value(x + h) - u.value(x - h)) / (2.0 * step), tolerance);
  }
}

TEST(ExactField, OuterSourceSolvesTheEquation) {
  const double lambda = 2.5;
  const ExactField u = outer_source("any", {0.3, -0.2, 1.9}, Vec3::UnitZ(), lambda);
  EXPECT_DOUBLE_EQ(u.value(Vec3::UnitZ()), 1.0);
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.5, -0.3, 0.4)}) {
    EXPECT_NEAR(laplacian(u, x), lambda * lambda * u.value(x), tolerance);
    check_gradient(u, x);
  }
}

TEST(ExactField, LayerHasTheSourceItIsSaidToHave) {
  const double s = 3.0;
  const ExactField u = decaying_layer(Vec3(1.0, 2.0, -2.0) / 3.0, s);
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.5, -0.3, 0.4)}) {
    EXPECT_NEAR(laplacian(u, x), s * s * u.value(x), tolerance);
    check_gradient(u, x);
  }
}

// Against the program's own coefficients.
TEST(DiffusionScale, IsThatOfAMedium) {
  const Body body = thin_torus();
  const DiffusionScale scale = scale_of(body, 4.0, 0.97);
  const Medium medium{0.03 * scale.sigma_tr, 0.97 * scale.sigma_tr, 0.0, 1.0, 0.0};
  const DiffusionCoefficients c = diffusion_coefficients(medium, Boundary::marshak);
  EXPECT_NEAR(c.lambda * body.half_extent, 4.0, 1e-12);
  EXPECT_NEAR(c.lambda, scale.lambda, 1e-12);
  EXPECT_NEAR(c.k, scale.k, 1e-12);
}

}  // namespace
}  // namespace knotlight
