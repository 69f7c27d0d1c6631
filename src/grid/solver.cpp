#include "grid/solver.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace knotlight {
namespace {

// The preconditioned iteration takes 5 to 20 steps; far more means that it does not converge.
constexpr int max_iterations = 400;

}  // namespace

GridLoad::GridLoad(const GridGeometry& geometry)
    : geometry_(&geometry), values_(Eigen::VectorXd::Zero(geometry.finest().dofs)) {
  assert(geometry.ok());
}

void GridLoad::add(const Place& place, double strength) {
  if (place.piece < 0) {
    lost_ += std::abs(strength);
    return;
  }
  const ElementVector n = strength * shape_functions(place.local);
  const auto& dof = geometry_->finest().pieces[static_cast<std::size_t>(place.piece)].dof;
  for (std::size_t c = 0; c < 8; ++c) values_[dof[c]] += n[static_cast<int>(c)];
}

void GridLoad::add_source(const Vec3& position, double strength) {
  add(geometry_->locate(position), strength);
}

void GridLoad::add_source(const Vec3& position, const Vec3& normal, double strength) {
  add(geometry_->locate(position, normal), strength);
}

void GridLoad::add_dipole(const Vec3& position, const Vec3& moment) {
  const Place place = geometry_->locate(position);
  if (place.piece < 0) {
    lost_ += moment.norm() / geometry_->h();
    return;
  }
  // Trilinear: differences over the whole cell are the exact derivatives.
  ElementVector load = ElementVector::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 low = place.local, high = place.local;
    low[axis] = 0.0;
    high[axis] = 1.0;
    load += moment[axis] / geometry_->h() * (shape_functions(high) - shape_functions(low));
  }
  const auto& dof = geometry_->finest().pieces[static_cast<std::size_t>(place.piece)].dof;
  for (std::size_t c = 0; c < 8; ++c) values_[dof[c]] += load[static_cast<int>(c)];
}

void GridLoad::add_sources(const Points& positions, const Eigen::VectorXd& strengths) {
  assert(positions.cols() == strengths.size());
  for (Eigen::Index i = 0; i < strengths.size(); ++i) add_source(positions.col(i), strengths[i]);
}

void GridLoad::add_uniform(double f) {
  if (f == 0.0) return;
  values_ -= f * node_weights(geometry_->finest()).volume;
}

void GridLoad::add_boundary_data(const Points& positions, const Points& normals,
                                 const Eigen::VectorXd& areas, const Eigen::VectorXd& g, double k) {
  assert(positions.cols() == g.size() && normals.cols() == g.size() && areas.size() == g.size());
  for (Eigen::Index i = 0; i < g.size(); ++i)
    add(geometry_->locate(positions.col(i), normals.col(i)), areas[i] * g[i] / k);
}

double GridField::at(const Place& place) const {
  if (place.piece < 0) return std::numeric_limits<double>::quiet_NaN();
  const ElementVector n = shape_functions(place.local);
  const auto& dof = geometry_->finest().pieces[static_cast<std::size_t>(place.piece)].dof;
  double sum = 0.0;
  for (std::size_t c = 0; c < 8; ++c) sum += n[static_cast<int>(c)] * values_[dof[c]];
  return sum;
}

double GridField::value(const Vec3& x) const {
  return geometry_ ? at(geometry_->locate(x)) : std::numeric_limits<double>::quiet_NaN();
}

double GridField::value_or_nothing(const Vec3& x) const {
  const Place place = geometry_->locate(x);
  return place.piece < 0 ? 0.0 : at(place);
}

double GridField::value(const Vec3& x, const Vec3& normal) const {
  return geometry_ ? at(geometry_->locate(x, normal)) : std::numeric_limits<double>::quiet_NaN();
}

GridField::Sample GridField::sample(const Vec3& x) const {
  const Place place = geometry_->locate(x);
  if (place.piece < 0)
    return {std::numeric_limits<double>::quiet_NaN(),
            Vec3::Constant(std::numeric_limits<double>::quiet_NaN())};
  Sample result{at(place), Vec3::Zero()};
  // Trilinear: differences over the whole cell are the exact derivatives.
  for (int axis = 0; axis < 3; ++axis) {
    Place low = place, high = place;
    low.local[axis] = 0.0;
    high.local[axis] = 1.0;
    result.gradient[axis] = (at(high) - at(low)) / geometry_->h();
  }
  return result;
}

Eigen::VectorXd GridField::values(const Points& x) const {
  Eigen::VectorXd u(x.cols());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = value(x.col(i));
  return u;
}

Eigen::VectorXd GridField::values(const Points& x, const Points& normals) const {
  assert(x.cols() == normals.cols());
  Eigen::VectorXd u(x.cols());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = value(x.col(i), normals.col(i));
  return u;
}

GridSolver::GridSolver(std::shared_ptr<const GridGeometry> geometry, double lambda, double k)
    : geometry_(std::move(geometry)),
      lambda_(lambda),
      k_(k),
      weights_(node_weights(geometry_->finest())),
      multigrid_(geometry_->levels(), {lambda, k}) {
  assert(geometry_->ok() && lambda >= 0.0 && k > 0.0);
}

GridSolution GridSolver::solve(const GridLoad& load, double tolerance) const {
  return solve(load.values(), tolerance);
}

GridSolution GridSolver::solve(const Eigen::VectorXd& load, double tolerance,
                               const Eigen::VectorXd& start) const {
  return solution(load, knotlight::solve(multigrid_, 0, load, start, tolerance, max_iterations));
}

GridSolution GridSolver::solve_coarse(const Eigen::VectorXd& load, double tolerance) const {
  assert(geometry_->has_nested_coarse());
  ConjugateGradientResult result =
      knotlight::solve(multigrid_, 1, multigrid_.restricted(load), {}, tolerance, max_iterations);
  result.x = multigrid_.prolonged(result.x);
  return solution(load, std::move(result));
}

GridSolution GridSolver::solution(const Eigen::VectorXd& load,
                                  ConjugateGradientResult result) const {
  GridSolution solution;
  solution.converged = result.converged;
  solution.iterations = result.iterations;
  solution.residual = result.residual;
  solution.volume_integral = weights_.volume.dot(result.x);
  solution.surface_integral = weights_.surface.dot(result.x);
  const double in = load.sum();
  const double out = lambda_ * lambda_ * solution.volume_integral + solution.surface_integral / k_;
  // No light, no imbalance; anything out of nothing is infinite.
  solution.imbalance = out == in ? 0.0 : (out - in) / in;
  solution.field = GridField(geometry_, std::move(result.x));
  return solution;
}

}  // namespace knotlight
