#include "study/absorption_correction.h"

#include <Eigen/QR>
#include <cmath>
#include <functional>
#include <limits>

namespace knotlight {
namespace {

// Far below any pivot of these matrices but those that are rounding.
constexpr double pivot_cut = 1e-13;
// Of the photon sum's bound; true errors are some 500 times smaller, below those of the cells.
constexpr double sum_tolerance = 1e-3;
constexpr double hopeless = 100.0;  // growth of the residual

using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

void richardson(const Operator& apply, const Eigen::VectorXd& b, double tolerance, int most,
                CorrectedField& result) {
  const double whole = b.norm();
  result.U = Eigen::VectorXd::Zero(b.size());
  Eigen::VectorXd residual = b;
  for (int i = 0; i < most && result.residuals.back() < hopeless; ++i) {
    result.U += residual;
    residual = b - apply(result.U);
    result.residuals.push_back(residual.norm() / whole);
    result.converged = result.residuals.back() <= tolerance;
    if (result.converged) return;
  }
}

// [SS86], without restarts; the small least-squares problem anew in each step.
void gmres(const Operator& apply, const Eigen::VectorXd& b, double tolerance, int most,
           CorrectedField& result) {
  const double whole = b.norm();
  Eigen::MatrixXd basis(b.size(), most + 1);
  Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd weights;
  basis.col(0) = b / whole;
  int steps = 0;
  while (steps < most && !result.converged) {
    Eigen::VectorXd next = apply(basis.col(steps));
    for (int i = 0; i <= steps; ++i) {
      hessenberg(i, steps) = basis.col(i).dot(next);
      next -= hessenberg(i, steps) * basis.col(i);
    }
    hessenberg(steps + 1, steps) = next.norm();
    // Should nothing be left, the residual is 0 and this column is not used.
    basis.col(steps + 1) = next / next.norm();
    ++steps;
    const Eigen::MatrixXd small = hessenberg.topLeftCorner(steps + 1, steps);
    const Eigen::VectorXd right = whole * Eigen::VectorXd::Unit(steps + 1, 0);
    weights = small.householderQr().solve(right);
    result.residuals.push_back((right - small * weights).norm() / whole);
    result.converged = result.residuals.back() <= tolerance;
  }
  result.U = basis.leftCols(steps) * weights;
}

}  // namespace

ChargeField::ChargeField(PhotonSum particular, GlobalField homogeneous, Workers workers)
    : particular_(std::move(particular)), homogeneous_(std::move(homogeneous)), workers_(workers) {}

Eigen::VectorXd ChargeField::values(const Points& x) const {
  constexpr std::size_t chunk = 256;
  Eigen::VectorXd u = particular_.evaluate(x, nullptr, workers_).value;
  workers_.for_chunks(static_cast<std::size_t>(x.cols()), chunk,
                      [&](std::size_t, std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i) {
                          const auto column = static_cast<Eigen::Index>(i);
                          u[column] += homogeneous_.value(x.col(column));
                        }
                      });
  return u;
}

ChargeSolver::ChargeSolver(double sigma0, double k, const SurfaceSamples& knots,
                           const Points& outside, const Workers& workers)
    : sigma0_(sigma0),
      boundary_({std::sqrt(sigma0), k, outside, knots.positions, knots.normals},
                GlobalBasis::exterior_sources, pivot_cut, workers),
      workers_(workers) {}

ChargeField ChargeSolver::field(const VolumeCells& cells, const Eigen::VectorXd& density) const {
  const GlobalBkmProblem& boundary = boundary_.problem();
  PointSources charges{
      cells.centers, density.cwiseProduct(cells.volumes), cells.nearest.positions,
      cells.nearest.normals,
      Eigen::VectorXd::Constant(cells.size(), std::numeric_limits<double>::infinity())};
  PhotonSum particular(std::move(charges), boundary.lambda, boundary.k,
                       {sum_tolerance, cells.radius()}, workers_);
  const PhotonSumValues left = particular.evaluate(boundary.knots, &boundary.normals, workers_);
  GlobalField homogeneous = boundary_.solve(-left.value - boundary.k * left.normal_derivative);
  return {std::move(particular), std::move(homogeneous), workers_};
}

CorrectedField correct_absorption(const AbsorptionProblem& p, CorrectionMethod method,
                                  double tolerance, int most) {
  const Eigen::VectorXd excess = p.sigma.array() - p.solver.sigma0();
  const Operator apply = [&](const Eigen::VectorXd& U) -> Eigen::VectorXd {
    return U + p.solver.field(p.cells, excess.cwiseProduct(U)).values(p.cells.centers);
  };
  const Eigen::VectorXd b = p.lit.values(p.cells.centers);
  CorrectedField result;
  result.residuals = {1.0};
  if (b.isZero(0.0)) {  // dark
    result.U = b;
    result.converged = true;
  } else {
    (method == CorrectionMethod::gmres ? gmres : richardson)(apply, b, tolerance, most, result);
  }
  result.absorbed =
      std::make_shared<const ChargeField>(p.solver.field(p.cells, -excess.cwiseProduct(result.U)));
  return result;
}

}  // namespace knotlight
