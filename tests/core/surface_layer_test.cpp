#include "core/surface_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/fresnel.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Chandrasekhar's H for isotropic scattering without absorption, H = 1 + mu/2 H int H(m)/(mu + m)
// dm, by iteration; q(tau) = q(inf) - 1/(2 sqrt 3) int exp(-tau/m) / (H(m) Z(m)) dm, Z as in the
// transient part [H34].
TEST(SurfaceLayer, IsHopfsFunctionWithoutReflection) {
  constexpr int n = 2000;
  std::vector<double> mu(n), H(n, 2.0), weight(n);
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n;  // mu = t^2 (3 - 2 t): dense at both ends
    mu[static_cast<std::size_t>(i)] = t * t * (3.0 - 2.0 * t);
    weight[static_cast<std::size_t>(i)] = 6.0 * t * (1.0 - t) / n;
  }
  for (int iteration = 0; iteration < 300; ++iteration) {
    std::vector<double> next(n);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      // 1/H = sqrt(1 - 1) + 1/2 int m H(m) / (mu + m) dm, the form that converges at albedo 1.
      for (std::size_t j = 0; j < n; ++j) sum += weight[j] * mu[j] * H[j] / (mu[i] + mu[j]);
      next[i] = 2.0 / sum;
    }
    double change = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double mean = 0.5 * (H[i] + next[i]);
      change = std::max(change, std::abs(mean - H[i]));
      H[i] = mean;
    }
    if (change < 1e-9) break;
  }
  constexpr double k = 0.710446;
  for (const double tau : {0.0, 0.02, 0.05, 0.15, 0.3, 0.7, 1.0, 2.2, 3.5, 6.0}) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double real = 1.0 - mu[i] * std::atanh(mu[i]);
      const double imaginary = 0.5 * pi * mu[i];
      sum += weight[i] * std::exp(-tau / mu[i]) / (H[i] * (real * real + imaginary * imaginary));
    }
    const double q = k - sum / (2.0 * std::sqrt(3.0));
    EXPECT_NEAR(SurfaceLayer(1.0).q(tau), q, 1e-3) << tau;
  }
  const SurfaceLayer layer(1.0);
  EXPECT_NEAR(layer.extrapolation(), k, 1e-3);
  EXPECT_NEAR(layer.q(0.0), 1.0 / std::sqrt(3.0), 1e-3);
  EXPECT_EQ(layer.weight(-1.0, k, 0.0), layer.weight(0.0, k, 0.0));
}

// In a ball of radius R the field without sources falls as (R + q - r) / r: its slope at the
// surface over its value is that of the bent extrapolation length.
TEST(BentExtrapolation, IsThatOfABall) {
  const double q = 0.710446, R = 12.0, step = 1e-5;
  const auto field = [&](double r) { return (R + q - r) / r; };
  const double slope = (field(R + step) - field(R - step)) / (2.0 * step);
  EXPECT_NEAR(bent_extrapolation(q, 1.0 / R), -field(R) / slope, 1e-6);
}

// By reciprocity tau + q(tau) is, up to a factor, how likely light that starts at tau gets deep
// down before it leaves: random walks, 200 000 each, standard error below 0.001 of a probability
// near 0.1 (q/25), a false alarm at 5 deviations once in two million.
TEST(SurfaceLayer, IsTheChanceToGetDeepDown) {
  constexpr double deep = 20.0;
  constexpr int walks = 200'000;
  for (const double ior : {1.0, 1.4}) {
    const SurfaceLayer layer(ior);
    Rng rng(11, Stream::tests, 0);
    for (const double start : {0.0, 0.7}) {
      int arrived = 0;
      for (int i = 0; i < walks; ++i) {
        double tau = start;
        while (true) {
          double mu = 2.0 * rng.uniform() - 1.0;
          const double way = sample_free_flight(rng.uniform(), 1.0);
          tau += way * mu;
          if (tau > deep) break;
          if (tau >= 0.0) continue;
          if (rng.uniform() >= fresnel_reflectance(-mu, 1.0 / ior)) break;
          tau = -tau;
          if (tau > deep) break;
        }
        if (tau > deep) ++arrived;
      }
      const double chance = static_cast<double>(arrived) / walks;
      // A walk that crosses `deep` is on average the extrapolation length beyond it.
      const double expected = (start + layer.q(start)) / (deep + layer.extrapolation() + 0.7104);
      EXPECT_NEAR(chance, expected, 5.0 * std::sqrt(expected / walks)) << ior << " " << start;
    }
  }
}

}  // namespace
}  // namespace knotlight
