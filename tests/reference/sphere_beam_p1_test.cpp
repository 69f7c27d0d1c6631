#include "reference/sphere_beam_p1.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/legendre.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// U_d on the surface of the unit ball, g = 0, boundary marshak, at mu = z: a Legendre/Chebyshev
// solution of the same equations made by another program, error below 1e-5 (absolute; its last
// digits are not smooth on the dark side).
struct Row {
  double mu;
  double U_d[3];  // (sigma_t, albedo) = (5, 0.99), (20, 0.9), (20, 0.999)
};
constexpr Row rows[] = {
    {-1.0, {0.003744257, 5.602603e-06, 0.0006950245}},
    {-0.9, {0.00426368, -2.981765e-07, 0.0007790811}},
    {-0.8, {0.004914899, 4.250483e-07, 0.0008916657}},
    {-0.7, {0.005749619, 7.386386e-07, 0.001032637}},
    {-0.6, {0.006847117, 1.084056e-06, 0.001214361}},
    {-0.5, {0.008330399, 1.6884e-06, 0.001456252}},
    {-0.4, {0.01039057, 8.732529e-06, 0.001798039}},
    {-0.3, {0.01331503, 3.145651e-05, 0.002310528}},
    {-0.2, {0.01749572, 0.0001371986, 0.003190787}},
    {-0.1, {0.02331598, 0.000855434, 0.005295832}},
    {0.0, {0.03063731, 0.00571846, 0.01305018}},
    {0.1, {0.03820389, 0.0145252, 0.02633351}},
    {0.2, {0.04532426, 0.02270998, 0.03963555}},
    {0.3, {0.05192697, 0.03011907, 0.05252564}},
    {0.4, {0.05803554, 0.03684072, 0.06495653}},
    {0.5, {0.06369354, 0.04295966, 0.07692854}},
    {0.6, {0.06894677, 0.04855734, 0.08846631}},
    {0.7, {0.07383754, 0.05369696, 0.09959146}},
    {0.8, {0.07840372, 0.05843524, 0.1103301}},
    {0.9, {0.0826785, 0.06281837, 0.120705}},
    {1.0, {0.08669092, 0.06688382, 0.1307355}},
};

TEST(SphereBeamP1, AgainstAnotherProgram) {
  constexpr double sigma_t[] = {5.0, 20.0, 20.0}, albedo[] = {0.99, 0.9, 0.999};
  for (int c = 0; c < 3; ++c) {
    const SphereBeamP1 ball({sigma_t[c] * (1.0 - albedo[c]), sigma_t[c] * albedo[c], 0.0, 1.0, 0.0},
                            Boundary::marshak, 1.0);
    for (const Row& row : rows) {
      const double across = std::sqrt(1.0 - row.mu * row.mu);
      EXPECT_NEAR(ball.U_d({0.6 * across, 0.8 * across, row.mu}), row.U_d[c], 1e-5)
          << c << " " << row.mu;
    }
  }
}

// What interacts minus what leaves must be what the field absorbs: 4 pi sigma_a times the integral
// of U_d, by Gauss points in r (three panels) and mu.
TEST(SphereBeamP1, EnergyBalancesWhateverTheAnisotropy) {
  const Quadrature gauss = gauss_legendre(24);
  for (const double g : {0.0, 0.8}) {
    const double radius = 1.5;
    const Medium medium{0.2, 6.0, g, 1.0, 0.0};
    const SphereBeamP1 ball(medium, Boundary::milne, radius);
    double integral = 0.0;
    for (const auto& [from, to] : {std::pair{0.0, 0.7}, {0.7, 1.3}, {1.3, radius}})
      for (std::size_t i = 0; i < gauss.nodes.size(); ++i)
        for (std::size_t j = 0; j < gauss.nodes.size(); ++j) {
          const double r = from + 0.5 * (to - from) * (1.0 + gauss.nodes[i]);
          const double mu = gauss.nodes[j];
          integral += 0.5 * (to - from) * gauss.weights[i] * gauss.weights[j] * 2.0 * pi * r * r *
                      ball.U_d({r * std::sqrt(1.0 - mu * mu), 0.0, r * mu});
        }
    EXPECT_NEAR(4.0 * pi * medium.sigma_a * integral, ball.power_absorbed(),
                1e-4 * ball.power_in());
  }
}

// The equation itself at points inside, by differences of U_d: lap U - lambda^2 U = f. The step
// leaves 1e-3 of f.
TEST(SphereBeamP1, SatisfiesTheEquation) {
  const Medium medium{0.5, 4.5, 0.6, 1.0, 0.0};
  const DiffusionCoefficients c = diffusion_coefficients(medium, Boundary::marshak);
  const SphereBeamP1 ball(medium, Boundary::marshak, 1.0);
  for (const Vec3& x : {Vec3(0.3, -0.1, 0.6), Vec3(0.1, 0.2, -0.4), Vec3(-0.5, 0.4, 0.1)}) {
    const double step = 0.01;
    double laplacian = -6.0 * ball.U_d(x);
    for (int axis = 0; axis < 3; ++axis)
      laplacian += ball.U_d(x + step * Vec3::Unit(axis)) + ball.U_d(x - step * Vec3::Unit(axis));
    laplacian /= step * step;
    const double f = c.source_per_U_ri * ball.U_ri(x);
    EXPECT_NEAR(laplacian - c.lambda * c.lambda * ball.U_d(x), f, 0.003 * std::abs(f));
  }
}

TEST(SphereBeamP1, RefusesOtherIndices) {
  EXPECT_THROW(SphereBeamP1({0.5, 4.5, 0.0, 1.3, 0.0}, Boundary::marshak, 1.0), std::domain_error);
}

}  // namespace
}  // namespace knotlight
