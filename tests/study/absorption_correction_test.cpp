#include "study/absorption_correction.h"

#include <gtest/gtest.h>

#include "study/varying_absorption.h"

namespace knotlight {
namespace {

// A glowing ball with a core that absorbs `contrast` times as much, solved about a third
// absorption.
class DarkCore : public testing::Test {
 protected:
  static constexpr double k = 0.07, shell = 1.5, core = 0.5;

  static ChargeSolver solver_about(double sigma0) {
    const SurfaceSamples knots{spread_directions(200), spread_directions(200)};
    return {sigma0, k, knots, 1.6 * spread_directions(100), Workers(1)};
  }
  static Eigen::VectorXd sigma_at(const VolumeCells& cells, double contrast) {
    return (cells.centers.colwise().norm().transpose().array() < core)
        .select(Eigen::VectorXd::Constant(cells.size(), contrast * shell),
                Eigen::VectorXd::Constant(cells.size(), shell));
  }
  static ChargeField lit(const ChargeSolver& solver) {
    const VolumeCells cells = cells_of_ball(12);
    return solver.field(cells, Eigen::VectorXd::Ones(cells.size()));
  }
  // Largest relative error at r = 0, 1/4, 1/2, 3/4.
  static double error(double contrast, double sigma0, int shells) {
    const ChargeSolver solver = solver_about(sigma0);
    const ChargeField light = lit(solver);
    const VolumeCells all = cells_of_ball(shells);
    const Eigen::VectorXd sigma = sigma_at(all, contrast);
    const CorrectedField corrected =
        correct_absorption({solver, light, all, sigma}, CorrectionMethod::gmres, 1e-6, 20);
    EXPECT_TRUE(corrected.converged);
    const int n = 1000;
    const Eigen::VectorXd truth =
        radial_differences(n, {k, [&](double r) { return r < core ? contrast * shell : shell; },
                               [](double) { return 1.0; }});
    double largest = 0.0;
    for (int i = 0; i < 4; ++i) {
      const Points x = 0.25 * i * spread_directions(7);
      const Eigen::VectorXd u = light.values(x) + corrected.absorbed->values(x);
      largest = std::max(largest, std::abs(u.mean() / truth[i * n / 4] - 1.0));
    }
    return largest;
  }
};

TEST_F(DarkCore, AgreesWithOneDimension) {
  EXPECT_LT(error(3.0, shell, 8), 0.02);
  EXPECT_LT(error(3.0, 2.0 * shell, 8), 0.02);  // cells are charges everywhere
  EXPECT_LT(error(20.0, shell, 8), 0.06);
}

// Second order in the cells' size: 3 and not 4 leaves room for the light's own cells.
TEST_F(DarkCore, GetsBetterWithFinerCells) {
  EXPECT_GT(error(20.0, shell, 4) / error(20.0, shell, 8), 3.0);
}

// What is corrected by nothing is the homogeneous body.
TEST_F(DarkCore, AnEvenBodyIsTheHomogeneousOne) {
  EXPECT_LT(error(1.0, shell, 2), 0.02);  // of the cells of its light
}

TEST_F(DarkCore, BothIterationsComeToTheSame) {
  const ChargeSolver solver = solver_about(shell);
  const ChargeField light = lit(solver);
  const VolumeCells all = cells_of_ball(4);
  const Eigen::VectorXd sigma = sigma_at(all, 5.0);
  const AbsorptionProblem problem{solver, light, all, sigma};
  const CorrectedField born = correct_absorption(problem, CorrectionMethod::born_series, 1e-7, 200);
  const CorrectedField gmres = correct_absorption(problem, CorrectionMethod::gmres, 1e-7, 20);
  ASSERT_TRUE(born.converged && gmres.converged);
  EXPECT_LT((born.U - gmres.U).norm() / gmres.U.norm(), 1e-5);
  EXPECT_LT(gmres.residuals.size(), born.residuals.size());
}

TEST_F(DarkCore, TheBornSeriesSaysThatItExplodes) {
  const ChargeSolver solver = solver_about(shell);
  const ChargeField light = lit(solver);
  const VolumeCells all = cells_of_ball(8);
  const Eigen::VectorXd sigma = sigma_at(all, 100.0);
  const AbsorptionProblem problem{solver, light, all, sigma};
  EXPECT_FALSE(correct_absorption(problem, CorrectionMethod::born_series, 1e-4, 100).converged);
  EXPECT_TRUE(correct_absorption(problem, CorrectionMethod::gmres, 1e-4, 20).converged);
}

}  // namespace
}  // namespace knotlight
