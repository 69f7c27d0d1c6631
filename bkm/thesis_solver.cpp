#include "bkm/thesis_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "bkm/assembly.h"

namespace knotlight {
namespace {

// Scaled with the largest distance between two knots no entry of the boundary matrix exceeds
// 1/(lambda R), and the largest does not underflow either.
BkmBasis basis_of(const BkmThesisProblem& problem, const BkmThesisOptions& options) {
  const double R = diameter(problem.boundary_points);
  RadialFunction homogeneous;
  homogeneous.kind = RadialKind::nonsingular;
  homogeneous.order = options.basis_order;
  homogeneous.lambda = problem.lambda;
  homogeneous.R = R;
  return {point_columns(all_points(problem)), radial_function(options, problem.lambda, R),
          point_columns(problem.boundary_points), homogeneous, options.precision};
}

DenseSolver factor(Eigen::MatrixXd a, const BkmThesisOptions& options) {
  zero_tiny_entries(a);
  return DenseSolver(std::move(a), {options.solver, options.relative_cut, options.workers});
}

Eigen::MatrixXd carried_by(const DenseSolver& particular, const BkmThesisProblem& problem,
                           const BkmBasis& basis, const BkmThesisOptions& options) {
  if (options.basis_order == 0) return {};
  return particular.solve_columns(source_matrix(all_points(problem), problem.boundary_points,
                                                basis.homogeneous,
                                                {options.precision, options.workers}));
}

}  // namespace

double diameter(const Points& points) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    largest =
        std::max(largest, (points.colwise() - points.col(j)).colwise().squaredNorm().maxCoeff());
  return std::sqrt(largest);
}

Points all_points(const BkmThesisProblem& problem) {
  Points all(3, problem.boundary_points.cols() + problem.interior_points.cols());
  all << problem.boundary_points, problem.interior_points;
  return all;
}

RadialFunction radial_function(const BkmThesisOptions& options, double lambda, double R) {
  return {options.radial, options.c, options.exponent, options.radial_order, lambda, R};
}

BkmThesisSolver::BkmThesisSolver(const BkmThesisProblem& problem, const BkmThesisOptions& options)
    : basis_(basis_of(problem, options)),
      knots_(problem.boundary_points),
      normals_(problem.boundary_normals),
      k_(problem.k),
      particular_(factor(source_matrix(all_points(problem), basis_.particular,
                                       {options.precision, options.workers}),
                         options)),
      carried_(carried_by(particular_, problem, basis_, options)),
      homogeneous_(factor(boundary_matrix(problem, options), options)) {
  assert(knots_.cols() >= 1 && normals_.cols() == knots_.cols());
  assert(!(problem.lambda < 0.0) && !(k_ < 0.0) && !(options.c <= 0.0));
  assert(options.radial_order >= 1 && options.radial_order <= max_order);
}

// Robin operator of the boundary basis, with what dual reciprocity takes away of it.
Eigen::MatrixXd BkmThesisSolver::boundary_matrix(const BkmThesisProblem& problem,
                                                 const BkmThesisOptions& options) const {
  const AssemblyOptions assembly{options.precision, options.workers};
  Eigen::MatrixXd robin = robin_matrix(knots_, normals_, knots_, k_, basis_.homogeneous, assembly);
  if (carried_.size() > 0)
    robin -= lapack::product(
        robin_matrix(knots_, normals_, all_points(problem), k_, basis_.particular, assembly),
        carried_, false, options.workers);
  return robin;
}

std::string BkmThesisSolver::message() const {
  if (!particular_.ok()) return "particular solution: " + particular_.message();
  if (!homogeneous_.ok()) return "homogeneous solution: " + homogeneous_.message();
  return {};
}

BkmField BkmThesisSolver::solve(const Eigen::VectorXd& f, const Eigen::VectorXd& g) const {
  BkmSolveFigures figures;
  return solve(f, g, figures);
}

BkmField BkmThesisSolver::solve(const Eigen::VectorXd& f, const Eigen::VectorXd& g,
                                BkmSolveFigures& figures) const {
  assert(f.size() == basis_.centers.rows());
  assert(g.size() == knots_.cols());
  DenseSolution alpha = particular_.solve_with_figures(f);
  // What the particular solution leaves of the boundary data [V09 5.25].
  const BkmField particular(basis_, alpha.x, {});
  Eigen::VectorXd rest(g.size());
  for (Eigen::Index i = 0; i < g.size(); ++i)
    rest(i) = g(i) - particular.robin(knots_.col(i), normals_.col(i), k_);
  DenseSolution beta = homogeneous_.solve_with_figures(rest);
  figures = {alpha.effective_condition, beta.effective_condition, alpha.regulariser,
             beta.regulariser};
  if (carried_.size() > 0) alpha.x -= carried_ * beta.x;
  return {basis_, std::move(alpha.x), std::move(beta.x)};
}

}  // namespace knotlight
