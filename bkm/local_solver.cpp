#include "bkm/local_solver.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

constexpr std::size_t patches_per_chunk = 32;

struct IterationResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  // relative
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

// BiCGSTAB [vdV92] for x - C x = d, begun anew from the true residual after so many steps, or where
// it breaks down: its short recurrence forgets, and the residual it carries along drifts away.
constexpr int steps_before_restart = 60;

IterationResult solve_fixed_point(const LinearMap& C, const Eigen::VectorXd& d, double tolerance,
                                  int most) {
  IterationResult result{Eigen::VectorXd::Zero(d.size())};
  const double norm = d.norm();
  if (norm == 0.0) return result;
  Eigen::VectorXd best = result.x;
  double best_residual = 1.0;
  while (result.iterations < most) {
    Eigen::VectorXd r = d - result.x + C(result.x);
    result.residual = r.norm() / norm;
    if (result.residual < best_residual) best = result.x, best_residual = result.residual;
    if (!(result.residual > tolerance)) break;
    const Eigen::VectorXd shadow = r;
    Eigen::VectorXd p = Eigen::VectorXd::Zero(d.size()), v = p;
    double rho = 1.0, alpha = 1.0, omega = 1.0;
    for (int step = 0; step < steps_before_restart; ++step) {
      const double rho_new = shadow.dot(r);
      if (rho_new == 0.0) break;
      p = r + rho_new / rho * alpha / omega * (p - omega * v);
      rho = rho_new;
      v = p - C(p);
      alpha = rho / shadow.dot(v);
      const Eigen::VectorXd s = r - alpha * v;
      const Eigen::VectorXd t = s - C(s);
      const double tt = t.squaredNorm();
      omega = tt > 0.0 ? t.dot(s) / tt : 0.0;
      result.x += alpha * p + omega * s;
      r = s - omega * t;
      ++result.iterations;
      if (!(r.norm() > tolerance * norm) || omega == 0.0) break;
    }
    if (!result.x.allFinite()) break;
  }
  result.x = best;
  result.residual = best_residual;
  return result;
}

}  // namespace

LocalField::LocalField(std::shared_ptr<const PatchTree> tree, BodyQueries body, Waves waves,
                       Eigen::VectorXd beta)
    : tree_(std::move(tree)),
      body_(std::move(body)),
      waves_(std::move(waves)),
      beta_(std::move(beta)) {}

double LocalField::value(const Vec3& x) const {
  const std::ptrdiff_t p = tree_->owner(x, body_);
  const auto patch = static_cast<std::size_t>(p);
  const SphericalWaves& waves = (*waves_)[patch];
  return waves.sum(x - tree_->patches()[patch].center,
                   beta_.segment(p * waves.size(), waves.size()));
}

double LocalField::robin(const Vec3& x, const Vec3& n, double k) const {
  const std::ptrdiff_t p = tree_->owner(x, body_);
  const auto patch = static_cast<std::size_t>(p);
  const SphericalWaves& waves = (*waves_)[patch];
  Eigen::VectorXd row(waves.size());
  waves.robin(x - tree_->patches()[patch].center, n, k, row);
  return row.dot(beta_.segment(p * waves.size(), waves.size()));
}

LocalBkmSolver::LocalBkmSolver(std::shared_ptr<const PatchTree> tree, const BodyQueries& body,
                               double lambda, double k, const LocalBkmOptions& options,
                               const Workers& workers)
    : tree_(std::move(tree)),
      options_(options),
      size_((options.degree + 1) * (options.degree + 1)),
      systems_(tree_->patches().size()) {
  auto waves = std::make_shared<std::vector<SphericalWaves>>();
  waves->reserve(systems_.size());
  for (const Patch& patch : tree_->patches())
    waves->emplace_back(options.degree, lambda, patch.radius);
  waves_ = std::move(waves);
  for_patches(workers, [&](std::size_t i) { factor(i, body, k); });
}

void LocalBkmSolver::factor(std::size_t index, const BodyQueries& body, double k) {
  const SpreadKnots& knots = tree_->knots();
  const Patch& patch = tree_->patches()[index];
  System& s = systems_[index];
  const SphericalWaves& waves = (*waves_)[index];
  const auto m = static_cast<Eigen::Index>(patch.knots.size());
  const auto a = static_cast<Eigen::Index>(patch.joints.size());
  Eigen::MatrixXd rows(size_, m + a);  // transposed: a row is contiguous
  Eigen::VectorXd weights(m + a);      // of the rows
  // u + k du/dn is (1 + k/h) times as large as u where u changes over the patch's radius h.
  const double robin_weight = std::sqrt(patch.knot_area) / (1.0 + k / patch.radius);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Index knot = patch.knots[static_cast<std::size_t>(i)];
    waves.robin(knots.positions.col(knot) - patch.center, knots.normals.col(knot), k, rows.col(i));
    weights[i] = robin_weight;
  }
  s.neighbours.resize(static_cast<std::size_t>(a));
  s.neighbour_rows.resize(size_, a);
  for (Eigen::Index i = 0; i < a; ++i) {
    const Vec3& x = patch.joints[static_cast<std::size_t>(i)];
    waves.values(x - patch.center, rows.col(m + i));
    weights[m + i] = std::sqrt(patch.joint_area);
    const std::ptrdiff_t owner = tree_->owner(x, body);
    s.neighbours[static_cast<std::size_t>(i)] = owner;
    const Patch& other = tree_->patches()[static_cast<std::size_t>(owner)];
    (*waves_)[static_cast<std::size_t>(owner)].values(x - other.center, s.neighbour_rows.col(i));
  }
  s.rows = rows.transpose();
  // Pseudo-inverse through the eigenvalues of the normal matrix, singular values squared.
  const Eigen::MatrixXd weighted = rows * weights.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(weighted * weighted.transpose());
  const double largest = eigen.eigenvalues().maxCoeff();
  const Eigen::VectorXd inverted = eigen.eigenvalues().unaryExpr(
      [&](double e) { return e > options_.cut * options_.cut * largest ? 1.0 / e : 0.0; });
  s.inverse = eigen.eigenvectors() * inverted.asDiagonal() *
              (eigen.eigenvectors().transpose() * weighted) * weights.asDiagonal();
}

Eigen::VectorXd LocalBkmSolver::joint_values(const System& s, const Eigen::VectorXd& beta) const {
  Eigen::VectorXd values(s.neighbour_rows.cols());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = s.neighbour_rows.col(i).dot(
        beta.segment(s.neighbours[static_cast<std::size_t>(i)] * size_, size_));
  return values;
}

Eigen::VectorXd LocalBkmSolver::knot_data(std::size_t patch, const Eigen::VectorXd& g) const {
  const std::vector<Eigen::Index>& knots = tree_->patches()[patch].knots;
  Eigen::VectorXd b(static_cast<Eigen::Index>(knots.size()));
  for (Eigen::Index j = 0; j < b.size(); ++j) b[j] = g[knots[static_cast<std::size_t>(j)]];
  return b;
}

void LocalBkmSolver::for_patches(const Workers& workers,
                                 const std::function<void(std::size_t)>& body) const {
  workers.for_chunks(systems_.size(), patches_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) body(i);
                     });
}

LocalSolution LocalBkmSolver::solve(const Eigen::VectorXd& g, const Workers& workers) const {
  const auto total = static_cast<Eigen::Index>(systems_.size()) * size_;
  Eigen::VectorXd d(total);
  for_patches(workers, [&](std::size_t i) {
    const Eigen::VectorXd b = knot_data(i, g);
    d.segment(static_cast<Eigen::Index>(i) * size_, size_) =
        systems_[i].inverse.leftCols(b.size()) * b;
  });
  const auto apply = [&](const Eigen::VectorXd& beta) -> Eigen::VectorXd {
    Eigen::VectorXd result(total);
    for_patches(workers, [&](std::size_t i) {
      const System& s = systems_[i];
      result.segment(static_cast<Eigen::Index>(i) * size_, size_) =
          s.inverse.rightCols(s.neighbour_rows.cols()) * joint_values(s, beta);
    });
    return result;
  };
  IterationResult iteration =
      solve_fixed_point(apply, d, options_.residual, options_.most_iterations);
  return {std::move(iteration.x), iteration.iterations, iteration.residual,
          iteration.residual <= options_.residual};
}

LocalField LocalBkmSolver::field(const LocalSolution& solution, const BodyQueries& body) const {
  return {tree_, body, waves_, solution.beta};
}

Eigen::VectorXd LocalBkmSolver::residuals(std::size_t patch, const LocalSolution& solution,
                                          const Eigen::VectorXd& g) const {
  const System& s = systems_[patch];
  Eigen::VectorXd r =
      -s.rows * solution.beta.segment(static_cast<Eigen::Index>(patch) * size_, size_);
  const Eigen::VectorXd b = knot_data(patch, g);
  r.head(b.size()) += b;
  r.tail(s.neighbour_rows.cols()) += joint_values(s, solution.beta);
  return r;
}

LocalMisfit LocalBkmSolver::misfit(const LocalSolution& a, const Eigen::VectorXd& g_a,
                                   const LocalSolution& b, const Eigen::VectorXd& g_b,
                                   const Workers& workers) const {
  const auto n = static_cast<Eigen::Index>(systems_.size());
  LocalMisfit misfit{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for_patches(workers, [&](std::size_t i) {
    const Eigen::VectorXd product = residuals(i, a, g_a).cwiseProduct(residuals(i, b, g_b));
    const Eigen::Index joints = systems_[i].neighbour_rows.cols();
    const Eigen::Index knots = product.size() - joints;
    const auto root = [](double sum, Eigen::Index count) {
      return count > 0 ? std::sqrt(std::abs(sum) / static_cast<double>(count)) : 0.0;
    };
    const auto row = static_cast<Eigen::Index>(i);
    misfit.boundary[row] = root(product.head(knots).sum(), knots);
    misfit.joints[row] = root(product.tail(joints).sum(), joints);
  });
  return misfit;
}

std::vector<Eigen::Index> LocalBkmSolver::knots_used() const {
  std::vector<Eigen::Index> used;
  for (const Patch& patch : tree_->patches())
    used.insert(used.end(), patch.knots.begin(), patch.knots.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

std::size_t LocalBkmSolver::unknowns() const {
  return systems_.size() * static_cast<std::size_t>(size_);
}

}  // namespace knotlight
