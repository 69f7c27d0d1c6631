#include "bkm/charge_cluster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bkm/robin_image.h"
#include "core/rng.h"

namespace knotlight {
namespace {

// Charges of both signs in a ball, the last one on its border.
std::vector<DirectCharge> charges_in_ball(double radius, std::size_t count) {
  Rng rng(5, Stream::tests, 1);
  std::vector<DirectCharge> charges;
  while (charges.size() < count) {
    const Vec3 y = radius * Vec3(2.0 * rng.uniform() - 1.0, 2.0 * rng.uniform() - 1.0,
                                 2.0 * rng.uniform() - 1.0);
    if (y.norm() < radius)
      charges.push_back({static_cast<float>(y.x()), static_cast<float>(y.y()),
                         static_cast<float>(y.z()), static_cast<float>(rng.uniform() - 0.4)});
  }
  charges.back().x = static_cast<float>(radius);
  charges.back().y = charges.back().z = 0.0F;
  return charges;
}

Vec3 position(const DirectCharge& charge) {
  return Vec3(Eigen::Vector3f(charge.x, charge.y, charge.z).cast<double>());
}

TEST(ChargeCluster, MonomialsAreIndexedInOrder) {
  for (int i = 0; i < cluster_terms; ++i) {
    const auto& e = monomial_table.exponents[static_cast<std::size_t>(i)];
    EXPECT_EQ(monomial_index(e[0], e[1], e[2]), i);
    EXPECT_LE(monomials(e[0] + e[1] + e[2] - 1), i);
  }
}

TEST(ChargeCluster, ShiftedMomentsAreThoseOfShiftedCharges) {
  const std::vector<DirectCharge> charges = charges_in_ball(0.5, 30);
  const Vec3 shift(0.25, -0.5, 0.125);
  std::vector<DirectCharge> moved = charges;
  for (DirectCharge& charge : moved) {
    charge.x += 0.25F;
    charge.y -= 0.5F;
    charge.z += 0.125F;
  }
  const MonomialSums expected = charge_moments(moved.data(), moved.size());
  const MonomialSums shifted =
      shifted_moments(charge_moments(charges.data(), charges.size()), shift);
  // Positions are rounded to float once more in `moved`.
  EXPECT_LT((shifted - expected).abs().maxCoeff(), 1e-5);
}

TEST(ChargeCluster, CoefficientsAreHarmonic) {
  const std::vector<DirectCharge> charges = charges_in_ball(1.0, 20);
  const MonomialSums H = harmonic_coefficients(charge_moments(charges.data(), charges.size()), 1.3);
  for (int i = 0; i < monomials(cluster_degree - 2); ++i) {
    const auto& e = monomial_table.exponents[static_cast<std::size_t>(i)];
    const auto second = [&](int a, int b, int c) {
      return H[monomial_index(e[0] + a, e[1] + b, e[2] + c)];
    };
    const double laplacian = (e[0] + 2) * (e[0] + 1) * second(2, 0, 0) +
                             (e[1] + 2) * (e[1] + 1) * second(0, 2, 0) +
                             (e[2] + 2) * (e[2] + 1) * second(0, 0, 2);
    EXPECT_NEAR(laplacian, 0.0, 1e-10) << i;
  }
}

// The expansion at every degree against the sum over charges, in many directions: never further
// off than the bound, and in the direction of a charge on the border not much nearer.
TEST(ChargeCluster, TruncationIsWithinItsBoundAndTheBoundIsSharp) {
  constexpr float radius = 0.4F;
  for (const double lambda : {0.0, 0.8, 6.0})
    for (const double r : {0.8, 1.2, 3.0}) {
      // One charge on the border, where Taylor's series is the worst.
      const DirectCharge charge{radius, 0.0F, 0.0F, 1.0F};
      const MonomialSums H = harmonic_coefficients(charge_moments(&charge, 1), lambda);
      Eigen::Array<float, cluster_terms, 1> coefficients = H.cast<float>();
      const double a = static_cast<double>(radius);
      const TruncationBounds bounds = truncation_bounds(r, a, a * a, lambda, std::exp(lambda * a));
      LanePoints points{};
      for (int lane = 0; lane < lane_count; ++lane) {
        const double angle = lane * 0.2;  // the first lane: straight towards the charge
        points.x[lane] = static_cast<float>(r * std::cos(angle));
        points.y[lane] = static_cast<float>(r * std::sin(angle));
        points.nx[lane] = lane == 0 ? 1.0F : 0.0F;
        points.nz[lane] = lane % 3 == 1 ? 0.6F : 0.0F;
        points.ny[lane] = lane == 0 ? 0.0F : lane % 3 == 1 ? 0.8F : 1.0F;
      }
      for (int degree = 0; degree <= cluster_degree; ++degree) {
        LaneSums sums{};
        add_cluster(points, coefficients.data(), degree, static_cast<float>(lambda), true, sums);
        const auto cut = static_cast<std::size_t>(degree + 1);
        for (int lane = 0; lane < lane_count; ++lane) {
          const Vec3 x(static_cast<double>(points.x[lane]), static_cast<double>(points.y[lane]),
                       0.0);
          const Vec3 n(static_cast<double>(points.nx[lane]), static_cast<double>(points.ny[lane]),
                       static_cast<double>(points.nz[lane]));
          const FieldSample exact = point_charge_field(x - position(charge), lambda);
          constexpr double to_field = 0.25 / 3.14159265358979323846;
          const double error =
              std::abs(to_field * static_cast<double>(sums.value[lane]) - exact.value);
          const double slope_error = std::abs(
              to_field * static_cast<double>(sums.derivative[lane]) - exact.gradient.dot(n));
          // Rounding to float, of terms that are larger than their sum where lambda r is large.
          const double rounding = 1e-5 * exact.value;
          const double slope_rounding = 1e-5 * exact.gradient.norm();
          EXPECT_LE(error, bounds.value[cut] + rounding) << lambda << ' ' << r << ' ' << degree;
          EXPECT_LE(slope_error, bounds.derivative[cut] + slope_rounding)
              << lambda << ' ' << r << ' ' << degree;
          if (lane == 0) {
            // Reached for lambda = 0; else the harmonics kept hold terms of higher degree as well.
            const double sharp = lambda == 0.0 ? 0.99 : 0.25;
            EXPECT_GE(error + rounding, sharp * bounds.value[cut]) << lambda << ' ' << r;
            EXPECT_GE(slope_error + slope_rounding, sharp * bounds.derivative[cut])
                << lambda << ' ' << r;
          }
        }
      }
    }
}

}  // namespace
}  // namespace knotlight
