#include "grid/operator.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "grid/grid_cases.h"

namespace knotlight {
namespace {

using namespace grid_cases;

Eigen::VectorXd random_vector(std::int32_t size, std::uint64_t stream) {
  Rng rng(5, Stream::tests, stream);
  Eigen::VectorXd x(size);
  for (double& v : x) v = rng.uniform() - 0.5;
  return x;
}

Eigen::MatrixXd dense(const GridOperator<double>& a) {
  Eigen::MatrixXd m(a.size(), a.size());
  Eigen::VectorXd column;
  for (std::int32_t i = 0; i < a.size(); ++i) {
    a.apply(Eigen::VectorXd::Unit(a.size(), i), column);
    m.col(i) = column;
  }
  return m;
}

// Stencil rows and cells added one by one must be one matrix: against plain assembly, without
// penalty.
TEST(GridOperator, EqualsAssembly) {
  const auto g = geometry(Sphere{Vec3(0.01, 0.02, 0.03), 1.0}, 0.23);
  const Level& level = g->finest();
  const double h = level.grid.h, lambda = 1.3, k = 0.4;
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(level.dofs, level.dofs);
  for (const Piece& piece : level.pieces) {
    const bool whole = piece.cut < 0;
    const Moments volume =
        whole ? full_cell_moments() : level.cuts[static_cast<std::size_t>(piece.cut)].volume;
    ElementMatrix e =
        h * stiffness_matrix(volume) + lambda * lambda * h * h * h * mass_matrix(volume);
    if (!whole)
      e += h * h / k * mass_matrix(level.cuts[static_cast<std::size_t>(piece.cut)].surface);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        expected(piece.dof[static_cast<std::size_t>(i)], piece.dof[static_cast<std::size_t>(j)]) +=
            e(i, j);
  }
  const GridOperator<double> a(level, {lambda, k, 0.0}, 1.0);
  const Eigen::MatrixXd found = dense(a);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((found.diagonal() - a.diagonal()).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(GridOperator, PenaltyIsSymmetricAndBlindToLinearFields) {
  const auto g = geometry(Sphere{Vec3(0.01, 0.02, 0.03), 1.0}, 0.23);
  const Level& level = g->finest();
  const GridOperator<double> with(level, {1.0, 0.4, 0.5}, 1.0),
      without(level, {1.0, 0.4, 0.0}, 1.0);
  const Eigen::MatrixXd penalty = dense(with) - dense(without);
  EXPECT_GT(penalty.norm(), 0.1);
  EXPECT_LT((penalty - penalty.transpose()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((dense(with).diagonal() - with.diagonal()).cwiseAbs().maxCoeff(), 1e-13);
  Eigen::VectorXd linear(level.dofs);
  for (const Piece& piece : level.pieces)
    for (int c = 0; c < 8; ++c) {
      const auto p = level.grid.position(piece.cell);
      const auto o = corner_offset(c);
      linear[piece.dof[static_cast<std::size_t>(c)]] =
          1.0 + 0.3 * (p[0] + o[0]) - 0.2 * (p[1] + o[1]) + 0.1 * (p[2] + o[2]);
    }
  EXPECT_LT((penalty * linear).cwiseAbs().maxCoeff(), 1e-12);
}

// In float and scaled: the same matrix to the rounding of its entries.
TEST(GridOperator, FloatIsTheSame) {
  const auto g = geometry(torus(1.0, 0.4, 40, 20), 0.06);
  const GridOperator<double> a(g->finest(), {2.0, 0.1}, 1.0);
  const GridOperator<float> b(a, 3.0);
  const Eigen::VectorXd x = random_vector(a.size(), 3);
  Eigen::VectorXd Ax;
  Eigen::VectorXf Bx;
  a.apply(x, Ax);
  b.apply(x.cast<float>(), Bx);
  EXPECT_LT((3.0 * Ax - Bx.cast<double>()).norm(), 1e-6 * (3.0 * Ax).norm());
  EXPECT_LT((3.0 * a.diagonal() - b.diagonal().cast<double>()).norm(),
            1e-6 * (3.0 * a.diagonal()).norm());
  // What y held before does not matter.
  Eigen::VectorXf again = Eigen::VectorXf::Constant(Bx.size(), 7.0F);
  b.apply(x.cast<float>(), again);
  EXPECT_EQ(again, Bx);
}

TEST(GridOperator, SymmetricOnATorus) {
  const auto g = geometry(torus(1.0, 0.4, 40, 20), 0.06);
  const GridOperator<double> a(g->finest(), {2.0, 0.1}, 1.0);
  const Eigen::VectorXd x = random_vector(a.size(), 1), y = random_vector(a.size(), 2);
  Eigen::VectorXd Ax, Ay;
  a.apply(x, Ax);
  a.apply(y, Ay);
  EXPECT_NEAR(y.dot(Ax) / x.dot(Ay), 1.0, 1e-10);
  EXPECT_GT(x.dot(Ax), 0.0);
}

}  // namespace
}  // namespace knotlight
