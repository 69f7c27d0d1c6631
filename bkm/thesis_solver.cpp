#include "bkm/thesis_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "bkm/assembly.h"

namespace knotlight {
namespace {

Points all_points(const BkmThesisProblem& problem) {
  Points all(3, problem.boundary_points.cols() + problem.interior_points.cols());
  all << problem.boundary_points, problem.interior_points;
  return all;
}

// The largest distance between two knots: scaled with it, no entry of the matrix exceeds 1/(lambda
// R), and the largest does not underflow either.
double knot_diameter(const Points& knots) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < knots.cols(); ++j)
    largest =
        std::max(largest, (knots.colwise() - knots.col(j)).colwise().squaredNorm().maxCoeff());
  return std::sqrt(largest);
}

BkmBasis basis_of(const BkmThesisProblem& problem, const BkmThesisOptions& options) {
  return {point_columns(all_points(problem)), point_columns(problem.boundary_points),
          problem.lambda, options.c, knot_diameter(problem.boundary_points)};
}

PseudoInverse factor(Eigen::MatrixXd a, double relative_cut) {
  zero_tiny_entries(a);
  return {std::move(a), relative_cut};
}

}  // namespace

BkmThesisSolver::BkmThesisSolver(const BkmThesisProblem& problem, const BkmThesisOptions& options)
    : basis_(basis_of(problem, options)),
      knots_(problem.boundary_points),
      normals_(problem.boundary_normals),
      k_(problem.k),
      particular_(factor(source_matrix(all_points(problem), options.c, problem.lambda),
                         options.relative_cut)),
      homogeneous_(factor(robin_matrix(knots_, normals_, problem.lambda, k_, basis_.R),
                          options.relative_cut)) {
  assert(knots_.cols() >= 1 && normals_.cols() == knots_.cols());
  assert(!(problem.lambda < 0.0) && !(k_ < 0.0) && !(options.c <= 0.0));
}

std::string BkmThesisSolver::message() const {
  if (!particular_.ok()) return "particular solution: " + particular_.message();
  if (!homogeneous_.ok()) return "homogeneous solution: " + homogeneous_.message();
  return {};
}

BkmField BkmThesisSolver::solve(const Eigen::VectorXd& f, const Eigen::VectorXd& g) const {
  assert(f.size() == basis_.gaussian_centers.rows());
  assert(g.size() == knots_.cols());
  const Eigen::VectorXd alpha = particular_.solve(f);
  // What the particular solution leaves of the boundary data [V09 5.25].
  const BkmField particular(basis_, alpha, {});
  Eigen::VectorXd rest(g.size());
  for (Eigen::Index i = 0; i < g.size(); ++i)
    rest(i) = g(i) - particular.robin(knots_.col(i), normals_.col(i), k_);
  return {basis_, alpha, homogeneous_.solve(rest)};
}

}  // namespace knotlight
