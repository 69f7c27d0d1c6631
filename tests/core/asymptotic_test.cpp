#include "core/asymptotic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

double midpoint(double a, double b, int n, const std::function<double(double)>& f) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += f(a + (b - a) * (i + 0.5) / n);
  return sum * (b - a) / n;
}

// All light of the source is absorbed somewhere: (1 - c) int phi dV = 1, so that
// strength / kappa^2 + int epsilon exp(-r) dr = 1 / (1 - c).
TEST(PointSourceField, AllLightIsAbsorbed) {
  for (const double albedo : {0.05, 0.3, 0.6, 0.9, 0.99, 0.999}) {
    for (const PointSourceField& field :
         {PointSourceField::exact(albedo), PointSourceField::grosjean(albedo)}) {
      const double near =
          midpoint(0.0, 30.0, 6000, [&](double r) { return field.epsilon(r) * std::exp(-r); });
      const double far =
          field.strength() == 0.0 ? 0.0 : field.strength() / (field.kappa() * field.kappa());
      EXPECT_NEAR((far + near) * (1.0 - albedo), 1.0, 1e-3) << albedo;
    }
  }
}

TEST(PointSourceField, RootAndLimits) {
  for (const double albedo : {0.3, 0.6, 0.9, 0.99, 1.0 - 1e-5}) {
    const double kappa = PointSourceField::exact(albedo).kappa();
    EXPECT_NEAR(albedo * std::atanh(kappa), kappa, 1e-9) << albedo;
  }
  const PointSourceField white = PointSourceField::exact(1.0);
  EXPECT_EQ(white.kappa(), 0.0);
  EXPECT_NEAR(white.strength(), 3.0, 1e-12);
  const PointSourceField black = PointSourceField::exact(0.0);
  EXPECT_NEAR(black.strength(), 0.0, 1e-12);
  for (const double r : {0.0, 0.5, 3.0}) EXPECT_NEAR(black.epsilon(r), 1.0, 1e-3) << r;
  // Continuous where the series takes over.
  EXPECT_NEAR(PointSourceField::exact(1.0 - 3.30e-5).strength(),
              PointSourceField::exact(1.0 - 3.37e-5).strength(), 1e-5);
}

// epsilon = r exp(r) int_0^1 g exp(-r / mu) / mu^2 dmu, summed as it stands.
TEST(PointSourceField, TransientPartIsItsIntegral) {
  for (const double albedo : {0.5, 0.9, 1.0}) {
    const PointSourceField field = PointSourceField::exact(albedo);
    for (const double r : {0.25, 1.0, 3.0}) {
      const double sum = midpoint(0.0, 1.0, 400'000, [&](double mu) {
        const double real = 1.0 - albedo * mu * std::atanh(mu);
        const double imaginary = 0.5 * pi * albedo * mu;
        return std::exp(-r / mu) / (mu * mu * (real * real + imaginary * imaginary));
      });
      EXPECT_NEAR(field.epsilon(r), r * std::exp(r) * sum, 1e-3) << albedo << " " << r;
    }
  }
}

// Sources and sinks of the P1 medium that stands for the asymptotic part.
TEST(AsymptoticMedium, HasItsExponentAndStrength) {
  const Medium medium{0.4, 3.6, 0.0, 1.3, 2.0};
  const PointSourceField field = PointSourceField::exact(medium.albedo());
  const Medium p1 = asymptotic_medium(medium, field);
  EXPECT_NEAR(p1.lambda(), field.kappa() * medium.sigma_t(), 1e-12);
  EXPECT_NEAR(p1.sigma_tr(), medium.sigma_t(), 1e-12);
  // A photon of unit power gives P1 the source 3 sigma_tr albedo / (4 pi).
  EXPECT_NEAR(3.0 * p1.sigma_tr() * p1.albedo() * asymptotic_power(medium, field),
              field.strength() * medium.sigma_t() * medium.albedo(), 1e-12);
}

}  // namespace
}  // namespace knotlight
