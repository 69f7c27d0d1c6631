#include "grid/multigrid.h"

#include <cmath>

namespace knotlight {
namespace {

// Chebyshev smoothing [A03]: the polynomial in D^-1 A of this degree is small over the upper part
// of the spectrum, which the coarser grid cannot see. Degree 3 from a fifth of the largest
// eigenvalue on costs the least time over all.
constexpr int smoothing_degree = 3;
constexpr double smoothed_share = 0.2;
constexpr int power_steps = 15;
// Power iterations stop short of the largest eigenvalue by a few per cent.
constexpr double eigenvalue_margin = 1.1;

}  // namespace

Multigrid::Multigrid(const std::vector<Level>& levels, const OperatorCoefficients& coefficients) {
  const double h = levels.front().grid.h;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    stages_.push_back(std::make_unique<Stage>(levels[l], coefficients, levels[l].grid.h / h));
    Stage& stage = *stages_.back();
    stage.inverse_diagonal =
        stage.matrix.diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / d : 0.0; });
    stage.largest_eigenvalue = eigenvalue_margin * largest_eigenvalue(stage);
    if (l + 1 < levels.size()) stage.parents = parents(levels[l], levels[l + 1]);
  }
  const GridOperator& last = stages_.back()->matrix;
  Eigen::MatrixXd dense(last.size(), last.size());
  Eigen::VectorXd column;
  for (std::int32_t i = 0; i < last.size(); ++i) {
    last.apply(Eigen::VectorXd::Unit(last.size(), i), column);
    dense.col(i) = column;
    if (column[i] == 0.0) dense(i, i) = 1.0;
  }
  coarsest_.compute(dense);
}

std::vector<Multigrid::Parent> Multigrid::parents(const Level& fine, const Level& coarse) {
  std::vector<Parent> result(static_cast<std::size_t>(fine.dofs));
  for (const Piece& piece : fine.pieces) {
    const auto p = fine.grid.position(piece.cell);
    const std::int32_t parent =
        coarse
            .first_piece[static_cast<std::size_t>(coarse.grid.index(p[0] / 2, p[1] / 2, p[2] / 2))];
    for (int c = 0; c < 8; ++c) {
      const auto o = corner_offset(c);
      result[static_cast<std::size_t>(piece.dof[static_cast<std::size_t>(c)])] = {
          parent, (p[0] & 1) + o[0] + 3 * ((p[1] & 1) + o[1]) + 9 * ((p[2] & 1) + o[2])};
    }
  }
  return result;
}

double Multigrid::largest_eigenvalue(const Stage& stage) {
  Eigen::VectorXd x(stage.level.dofs), y;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = std::cos(2.4 * static_cast<double>(i * i % 1009));
  double eigenvalue = 0.0;
  for (int step = 0; step < power_steps; ++step) {
    x /= x.norm();
    stage.matrix.apply(x, y);
    x = stage.inverse_diagonal.cwiseProduct(y);
    eigenvalue = x.norm();
  }
  return eigenvalue;
}

// Improves v.x for v.rhs; v.residual holds rhs - A x on entry and is stale on return.
void Multigrid::smooth(const Stage& stage, Workspace::Vectors& v) {
  const double hi = stage.largest_eigenvalue, lo = smoothed_share * hi;
  const double theta = 0.5 * (hi + lo), delta = 0.5 * (hi - lo), sigma = theta / delta;
  double rho = 1.0 / sigma;
  Eigen::VectorXd product;
  v.direction = stage.inverse_diagonal.cwiseProduct(v.residual) / theta;
  for (int step = 1;; ++step) {
    v.x += v.direction;
    if (step == smoothing_degree) return;
    stage.matrix.apply(v.direction, product);
    v.residual -= product;
    const double next = 1.0 / (2.0 * sigma - rho);
    v.direction = next * rho * v.direction +
                  (2.0 * next / delta) * stage.inverse_diagonal.cwiseProduct(v.residual);
    rho = next;
  }
}

void Multigrid::cycle(std::size_t at, Workspace& work) const {
  const Stage& stage = *stages_[at];
  Workspace::Vectors& v = work.levels[at];
  if (at + 1 == stages_.size()) {
    v.x = coarsest_.solve(v.rhs);
    return;
  }
  v.x.setZero(stage.level.dofs);
  v.residual = v.rhs;
  smooth(stage, v);
  stage.matrix.apply(v.x, v.residual);
  v.residual = v.rhs - v.residual;

  static const std::array<ElementVector, 27> weights = [] {
    std::array<ElementVector, 27> w;
    for (int c = 0; c < 27; ++c) {
      const int i = c % 3, j = c / 3 % 3, k = c / 9;
      w[static_cast<std::size_t>(c)] = shape_functions(0.5 * Vec3(i, j, k));
    }
    return w;
  }();
  const Level& coarse = stages_[at + 1]->level;
  Workspace::Vectors& below = work.levels[at + 1];
  below.rhs.setZero(coarse.dofs);
  for (std::size_t i = 0; i < stage.parents.size(); ++i) {
    const auto& dof = coarse.pieces[static_cast<std::size_t>(stage.parents[i].piece)].dof;
    const ElementVector& w = weights[static_cast<std::size_t>(stage.parents[i].code)];
    const double r = v.residual[static_cast<Eigen::Index>(i)];
    for (std::size_t c = 0; c < 8; ++c) below.rhs[dof[c]] += w[static_cast<int>(c)] * r;
  }
  cycle(at + 1, work);
  for (std::size_t i = 0; i < stage.parents.size(); ++i) {
    const auto& dof = coarse.pieces[static_cast<std::size_t>(stage.parents[i].piece)].dof;
    const ElementVector& w = weights[static_cast<std::size_t>(stage.parents[i].code)];
    double sum = 0.0;
    for (std::size_t c = 0; c < 8; ++c) sum += w[static_cast<int>(c)] * below.x[dof[c]];
    v.x[static_cast<Eigen::Index>(i)] += sum;
  }
  stage.matrix.apply(v.x, v.residual);
  v.residual = v.rhs - v.residual;
  smooth(stage, v);
}

Multigrid::Workspace Multigrid::workspace() const {
  Workspace work;
  work.levels.resize(stages_.size());
  return work;
}

void Multigrid::precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z, Workspace& work) const {
  work.levels.front().rhs = r;
  cycle(0, work);
  z = work.levels.front().x;
}

ConjugateGradientResult solve(const Multigrid& multigrid, const Eigen::VectorXd& b,
                              double tolerance, int max_iterations) {
  ConjugateGradientResult result;
  result.x = Eigen::VectorXd::Zero(b.size());
  const double size = b.norm();
  if (size == 0.0) {
    result.converged = true;
    return result;
  }
  Multigrid::Workspace work = multigrid.workspace();
  Eigen::VectorXd r = b, z, p, Ap;
  multigrid.precondition(r, z, work);
  p = z;
  double rz = r.dot(z);
  result.residual = r.norm() / size;
  while (result.iterations < max_iterations && std::isfinite(result.residual)) {
    multigrid.finest().apply(p, Ap);
    const double alpha = rz / p.dot(Ap);
    result.x += alpha * p;
    r -= alpha * Ap;
    ++result.iterations;
    result.residual = r.norm() / size;
    if (result.residual <= tolerance) {
      result.converged = true;
      break;
    }
    multigrid.precondition(r, z, work);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return result;
}

}  // namespace knotlight
