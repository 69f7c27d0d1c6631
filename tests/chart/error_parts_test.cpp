#include "chart/error_parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "chart/picture_blocks.h"
#include "core/rng.h"

namespace knotlight {
namespace {

constexpr Eigen::Index size = 800;  // blocks of a usual picture

double rms(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return block_error(a, b);
}

// 1, and white noise of this size about it.
Eigen::VectorXd noisy(double noise, std::uint64_t seed) {
  Rng rng(seed, Stream::tests, 0);
  Eigen::VectorXd values(size);
  for (double& value : values)
    value = 1.0 + noise * std::sqrt(-2.0 * std::log(1.0 - rng.uniform())) *
                      std::cos(2.0 * M_PI * rng.uniform());
  return values;
}

TEST(ErrorParts, TellsNoiseCoarsenessAndModelApart) {
  const Eigen::VectorXd truth = Eigen::VectorXd::Ones(size);
  const Eigen::VectorXd converged = 1.03 * truth;  // the model is 3 % off
  std::vector<Eigen::VectorXd> values;             // 4 % coarseness on the other side, 1 % noise
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    values.push_back(noisy(0.01, seed).array() - 0.01);
  const ErrorParts parts = error_parts(values, truth, 0.0, converged, rms);
  // Relative standard error of each rms: 1 / sqrt(2 x 800 x 3) = 1.4 %; five of them.
  EXPECT_NEAR(parts.noise, 0.01, 0.07 * 0.01);
  EXPECT_NEAR(parts.model, 0.03, 1e-12);
  EXPECT_NEAR(parts.numerical, 0.04 / 1.03, 0.001);
  EXPECT_NEAR(parts.error, std::hypot(0.01, 0.01), 0.001);
}

// A perfect picture beside a truth of 1 % noise: nothing can be said below a third of that, and 0
// would be a lie.
TEST(ErrorParts, NoErrorIsBelowWhatTheTruthHides) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ErrorParts parts =
        error_parts({Eigen::VectorXd::Ones(size)}, noisy(0.01, seed), 0.01, {}, rms);
    EXPECT_GT(parts.error, 0.003);
    EXPECT_LT(parts.error, 0.006);  // five standard errors
  }
}

}  // namespace
}  // namespace knotlight
