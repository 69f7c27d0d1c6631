#include "grid/multigrid.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

// Chebyshev smoothing [A03]: the polynomial in D^-1 A of this degree is small over the upper part
// of the spectrum, which the coarser grid cannot see. Degree 3 from a fifth of the largest
// eigenvalue on costs the least time over all.
constexpr int smoothing_degree = 3;
constexpr float smoothed_share = 0.2F;
constexpr int lanczos_steps = 8;
// Lanczos steps stop short of the largest eigenvalue by a few per cent.
constexpr double eigenvalue_margin = 1.1;

// The corners of a coarse cell that a node at half edges (x, y, z) of it is interpolated from.
struct HalfEdgeWeights {
  int count = 0;
  std::array<std::uint8_t, 8> corner{};
  std::array<float, 8> weight{};  // powers of 1/2: exact
};

const std::array<HalfEdgeWeights, 27>& half_edge_weights() {
  static const std::array<HalfEdgeWeights, 27> table = [] {
    std::array<HalfEdgeWeights, 27> t;
    for (int code = 0; code < 27; ++code) {
      HalfEdgeWeights& w = t[static_cast<std::size_t>(code)];
      const int x = code % 3, y = code / 3 % 3, z = code / 9;
      const ElementVector n = shape_functions(0.5 * Vec3(x, y, z));
      for (int c = 0; c < 8; ++c)
        if (n[c] != 0.0) {
          w.corner[static_cast<std::size_t>(w.count)] = static_cast<std::uint8_t>(c);
          w.weight[static_cast<std::size_t>(w.count++)] = static_cast<float>(n[c]);
        }
    }
    return t;
  }();
  return table;
}

}  // namespace

Multigrid::Multigrid(const std::vector<Level>& levels, const OperatorCoefficients& coefficients) {
  const double h = levels.front().grid.h;
  stages_.reserve(levels.size());
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const double own_grid = l == 0 ? h : levels[1].grid.h;
    GridOperator<double> matrix(levels[l], coefficients, levels[l].grid.h / own_grid);
    Stage& stage = stages_.emplace_back(levels[l], GridOperator<float>(matrix, 1.0 / h));
    if (l < 2) matrices_.push_back(std::move(matrix));
    stage.inverse_diagonal =
        stage.matrix.diagonal().unaryExpr([](float d) { return d > 0.0F ? 1.0F / d : 0.0F; });
    stage.largest_eigenvalue = largest_eigenvalue(stage);
    if (l + 1 < levels.size()) stage.parents = parents(levels[l], levels[l + 1]);
  }
  const GridOperator<float>& last = stages_.back().matrix;
  Eigen::MatrixXd dense(last.size(), last.size());
  Eigen::VectorXf column;
  for (std::int32_t i = 0; i < last.size(); ++i) {
    last.apply(Eigen::VectorXf::Unit(last.size(), i), column);
    dense.col(i) = column.cast<double>();
    if (column[i] == 0.0F) dense(i, i) = 1.0;
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

// The largest Ritz value of D^-1/2 A D^-1/2 after a few Lanczos steps.
float Multigrid::largest_eigenvalue(const Stage& stage) {
  const Eigen::Index n = stage.level.dofs;
  const Eigen::VectorXf root = stage.inverse_diagonal.cwiseSqrt();
  Eigen::VectorXf v(n), before = Eigen::VectorXf::Zero(n), w, product;
  for (Eigen::Index i = 0; i < n; ++i)
    v[i] = static_cast<float>(std::cos(2.4 * static_cast<double>(i * i % 1009)));
  v /= v.norm();
  const auto steps = std::min<Eigen::Index>(lanczos_steps, n);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(steps), beside = Eigen::VectorXd::Zero(steps);
  for (Eigen::Index step = 0; step < steps; ++step) {
    w = root.cwiseProduct(v);
    stage.matrix.apply(w, product);
    w = root.cwiseProduct(product);
    const float own = w.dot(v);
    diagonal[step] = own;
    w -= own * v;
    if (step > 0) w -= static_cast<float>(beside[step - 1]) * before;
    beside[step] = w.norm();
    if (!(beside[step] > 0.0)) break;
    before.swap(v);
    v = w / static_cast<float>(beside[step]);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(diagonal, beside.head(steps - 1), Eigen::EigenvaluesOnly);
  return static_cast<float>(eigenvalue_margin * ritz.eigenvalues().maxCoeff());
}

// Improves v.x for v.rhs; v.residual holds rhs - A x on entry and is stale on return.
void Multigrid::smooth(const Stage& stage, Workspace::Vectors& v) {
  const float hi = stage.largest_eigenvalue, lo = smoothed_share * hi;
  const float theta = 0.5F * (hi + lo), delta = 0.5F * (hi - lo), sigma = theta / delta;
  float rho = 1.0F / sigma;
  const Eigen::Index n = stage.level.dofs;
  v.direction.resize(n);
  float* const x = v.x.data();
  float* const residual = v.residual.data();
  float* const direction = v.direction.data();
  const float* const inverse = stage.inverse_diagonal.data();
  const float first = 1.0F / theta;
  for (Eigen::Index i = 0; i < n; ++i) {
    direction[i] = first * inverse[i] * residual[i];
    x[i] += direction[i];
  }
  for (int step = 1; step < smoothing_degree; ++step) {
    stage.matrix.apply(v.direction, v.product);
    const float* const product = v.product.data();
    const float next = 1.0F / (2.0F * sigma - rho);
    const float keep = next * rho, add = 2.0F * next / delta;
    // One pass over memory for all three updates.
    for (Eigen::Index i = 0; i < n; ++i) {
      residual[i] -= product[i];
      direction[i] = keep * direction[i] + add * inverse[i] * residual[i];
      x[i] += direction[i];
    }
    rho = next;
  }
}

template <class Vector>
void Multigrid::restrict_from(std::size_t at, const Vector& fine, Vector& coarse) const {
  const Stage& stage = stages_[at];
  const Level& below = stages_[at + 1].level;
  const auto& weights = half_edge_weights();
  coarse.setZero(below.dofs);
  for (std::size_t i = 0; i < stage.parents.size(); ++i) {
    const auto& dof = below.pieces[static_cast<std::size_t>(stage.parents[i].piece)].dof;
    const HalfEdgeWeights& w = weights[static_cast<std::size_t>(stage.parents[i].code)];
    const auto value = fine[static_cast<Eigen::Index>(i)];
    for (std::size_t c = 0; c < static_cast<std::size_t>(w.count); ++c)
      coarse[dof[w.corner[c]]] += w.weight[c] * value;
  }
}

template <class Vector>
void Multigrid::prolong_to(std::size_t at, const Vector& coarse, Vector& fine) const {
  const Stage& stage = stages_[at];
  const Level& below = stages_[at + 1].level;
  const auto& weights = half_edge_weights();
  for (std::size_t i = 0; i < stage.parents.size(); ++i) {
    const auto& dof = below.pieces[static_cast<std::size_t>(stage.parents[i].piece)].dof;
    const HalfEdgeWeights& w = weights[static_cast<std::size_t>(stage.parents[i].code)];
    typename Vector::Scalar sum = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(w.count); ++c)
      sum += w.weight[c] * coarse[dof[w.corner[c]]];
    fine[static_cast<Eigen::Index>(i)] += sum;
  }
}

Eigen::VectorXd Multigrid::prolonged(const Eigen::VectorXd& coarse) const {
  Eigen::VectorXd fine = Eigen::VectorXd::Zero(stages_[0].level.dofs);
  prolong_to(0, coarse, fine);
  return fine;
}

Eigen::VectorXd Multigrid::restricted(const Eigen::VectorXd& fine) const {
  Eigen::VectorXd coarse;
  restrict_from(0, fine, coarse);
  return coarse;
}

void Multigrid::cycle(std::size_t at, Workspace& work) const {
  const Stage& stage = stages_[at];
  Workspace::Vectors& v = work.levels[at];
  if (at + 1 == stages_.size()) {
    v.x = coarsest_.solve(v.rhs.cast<double>()).cast<float>();
    return;
  }
  v.x.setZero(stage.level.dofs);
  v.residual = v.rhs;
  smooth(stage, v);
  stage.matrix.apply(v.x, v.product);
  v.residual = v.rhs - v.product;
  restrict_from(at, v.residual, work.levels[at + 1].rhs);
  cycle(at + 1, work);
  prolong_to(at, work.levels[at + 1].x, v.x);
  stage.matrix.apply(v.x, v.product);
  v.residual = v.rhs - v.product;
  smooth(stage, v);
}

Multigrid::Workspace Multigrid::workspace() const {
  Workspace work;
  work.levels.resize(stages_.size());
  return work;
}

void Multigrid::precondition(std::size_t at, const Eigen::VectorXd& r, Eigen::VectorXd& z,
                             Workspace& work) const {
  // Scaled to the middle of float's range; the V-cycle is linear.
  const double size = r.norm();
  if (size == 0.0) {
    z.setZero(r.size());
    return;
  }
  work.levels[at].rhs = (r / size).cast<float>();
  cycle(at, work);
  z = size * work.levels[at].x.cast<double>();
}

ConjugateGradientResult solve(const Multigrid& multigrid, std::size_t at, const Eigen::VectorXd& b,
                              const Eigen::VectorXd& start, double tolerance, int max_iterations) {
  const GridOperator<double>& A = multigrid.matrix(at);
  ConjugateGradientResult result;
  result.x = Eigen::VectorXd::Zero(b.size());
  const double size = b.norm();
  if (size == 0.0) {
    result.converged = true;
    return result;
  }
  Eigen::VectorXd r = b, z, p, Ap;
  if (start.size() != 0) {
    result.x = start;
    A.apply(result.x, Ap);
    r -= Ap;
  }
  Multigrid::Workspace work = multigrid.workspace();
  double rz = 0.0;
  result.residual = r.norm() / size;
  result.converged = result.residual <= tolerance;
  while (!result.converged && result.iterations < max_iterations &&
         std::isfinite(result.residual)) {
    multigrid.precondition(at, r, z, work);
    const double next = r.dot(z);
    if (result.iterations == 0)
      p = z;
    else
      p = z + next / rz * p;
    rz = next;
    A.apply(p, Ap);
    const double alpha = rz / p.dot(Ap);
    result.x += alpha * p;
    r -= alpha * Ap;
    ++result.iterations;
    result.residual = r.norm() / size;
    result.converged = result.residual <= tolerance;
  }
  return result;
}

}  // namespace knotlight
