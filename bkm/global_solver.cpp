#include "bkm/global_solver.h"

#include <algorithm>
#include <cmath>

#include "bkm/kernels.h"

namespace knotlight {
namespace {

// Value and slope of the basis function at distance r from its centre; R scales sinh(lambda r).
RadialValue basis_function(GlobalBasis basis, double r, double lambda, double R) {
  if (basis == GlobalBasis::nonsingular_solutions) return nonsingular_solution(r, lambda, R);
  const double value = std::exp(-lambda * r) / r;
  return {value, -(lambda + 1.0 / r) * value};
}

// u + k du/dn of the basis function about `center`.
double basis_robin(GlobalBasis basis, const Vec3& center, const Vec3& x, const Vec3& n,
                   double lambda, double k, double R) {
  const Vec3 d = x - center;
  const double r = d.norm();
  const RadialValue f = basis_function(basis, r, lambda, R);
  return f.value + (r > 0.0 ? k * f.derivative * d.dot(n) / r : 0.0);
}

// The diagonal of the box around the points: no distance between them is larger.
double extent(const Points& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

}  // namespace

GlobalField::GlobalField(GlobalBasis basis, double lambda, Points centers,
                         Eigen::VectorXd coefficients)
    : basis_(basis),
      lambda_(lambda),
      R_(extent(centers)),
      centers_(std::move(centers)),
      coefficients_(std::move(coefficients)) {}

double GlobalField::value(const Vec3& x) const {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < coefficients_.size(); ++j)
    sum +=
        coefficients_[j] * basis_function(basis_, (x - centers_.col(j)).norm(), lambda_, R_).value;
  return sum;
}

double GlobalField::robin(const Vec3& x, const Vec3& n, double k) const {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < coefficients_.size(); ++j)
    sum += coefficients_[j] * basis_robin(basis_, centers_.col(j), x, n, lambda_, k, R_);
  return sum;
}

GlobalBkmSolver::GlobalBkmSolver(GlobalBkmProblem problem, GlobalBasis basis, double cut,
                                 const Workers& workers)
    : problem_(std::move(problem)), basis_(basis) {
  const Eigen::Index rows = problem_.knots.cols();
  const Eigen::Index columns = problem_.centers.cols();
  const double R = extent(problem_.centers);
  Eigen::MatrixXd a(rows, columns);
  scales_.resize(columns);
  constexpr std::size_t columns_per_chunk = 32;
  workers.for_chunks(
      static_cast<std::size_t>(columns), columns_per_chunk,
      [&](std::size_t, std::size_t begin, std::size_t end) {
        for (auto j = static_cast<Eigen::Index>(begin); j < static_cast<Eigen::Index>(end); ++j) {
          for (Eigen::Index i = 0; i < rows; ++i)
            a(i, j) = basis_robin(basis_, problem_.centers.col(j), problem_.knots.col(i),
                                  problem_.normals.col(i), problem_.lambda, problem_.k, R);
          const double norm = a.col(j).norm();
          scales_[j] = norm > 0.0 ? 1.0 / norm : 0.0;
          a.col(j) *= scales_[j];
        }
      });
  qr_ = lapack::pivoted_qr(std::move(a));
  const double largest = columns > 0 ? std::abs(qr_.a(0, 0)) : 0.0;
  while (rank_ < columns && std::abs(qr_.a(rank_, rank_)) > cut * largest) ++rank_;
}

GlobalField GlobalBkmSolver::solve(const Eigen::VectorXd& g) const {
  const Eigen::MatrixXd rotated = lapack::apply_q_transposed(qr_, g);
  const Eigen::VectorXd found = qr_.a.topLeftCorner(rank_, rank_)
                                    .triangularView<Eigen::Upper>()
                                    .solve(rotated.col(0).head(rank_));
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(problem_.centers.cols());
  for (Eigen::Index i = 0; i < rank_; ++i) beta[qr_.columns[i] - 1] = found[i];
  return {basis_, problem_.lambda, problem_.centers, scales_.cwiseProduct(beta)};
}

double GlobalBkmSolver::condition() const {
  const Eigen::Index n = qr_.a.cols();
  return n > 0 ? std::abs(qr_.a(0, 0) / qr_.a(n - 1, n - 1)) : 1.0;
}

}  // namespace knotlight
