#include "study/lit_ball.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

const Eigen::VectorXd cosines = Eigen::VectorXd::LinSpaced(21, -1.0, 1.0);

// k = 0 is Dirichlet's condition: the data themselves, as far as 2000 terms carry a kink.
TEST(LitBall, IsItsDataOnAHardSurface) {
  EXPECT_NEAR((lit_ball_field(cosines, 1.0, 1e-12) - cosines.unaryExpr(&lit_ball_data))
                  .cwiseAbs()
                  .maxCoeff(),
              0.0, 1e-3);
}

// max(0, mu) = mu/2 + |mu|/2: the odd part is the wave i_1 alone, i_1' = i_0 - 2 i_1 at lambda = 1.
TEST(LitBall, OddPartIsOneWave) {
  constexpr double k = 0.3;
  const double i0 = std::sinh(1.0), i1 = std::cosh(1.0) - std::sinh(1.0);
  const double expected = 0.5 / (1.0 + k * (i0 - 2.0 * i1) / i1);
  const Eigen::VectorXd u = lit_ball_field(cosines, 1.0, k);
  for (Eigen::Index i = 0; i < cosines.size(); ++i)
    EXPECT_NEAR(0.5 * (u[i] - u[cosines.size() - 1 - i]), expected * cosines[i], 1e-12);
}

}  // namespace
}  // namespace knotlight
