#include "study/multiple_reciprocity.h"

#include <cmath>
#include <numbers>

#include "bkm/assembly.h"
#include "bkm/thesis_solver.h"

namespace knotlight {
namespace {

RadialFunction wave_of(int order, double lambda, double size) {
  RadialFunction wave;
  wave.kind = RadialKind::nonsingular;
  wave.order = order;
  wave.lambda = lambda;
  wave.R = size;
  return wave;
}

}  // namespace

BoundaryParticles::BoundaryParticles(double lambda, double k, SurfaceSamples knots)
    : lambda_(lambda),
      k_(k),
      size_(diameter(knots.positions)),
      knots_(std::move(knots)),
      waves_(matrix(knots_.positions, knots_.normals, 0.0, 0)),
      robin_(matrix(knots_.positions, knots_.normals, k_, 0)) {}

Eigen::MatrixXd BoundaryParticles::matrix(const Points& at, const Points& normals, double k,
                                          int order) const {
  return robin_matrix(at, normals, knots_.positions, k, wave_of(order, lambda_, size_));
}

Eigen::MatrixXd BoundaryParticles::solve(const Eigen::MatrixXd& chain,
                                         const Eigen::VectorXd& g) const {
  const Eigen::Index top = chain.cols();
  Eigen::MatrixXd weights(chain.rows(), top + 1);
  Eigen::VectorXd rest = g;
  for (Eigen::Index m = top; m > 0; --m) {
    Eigen::VectorXd f = chain.col(m - 1);
    for (Eigen::Index j = m + 1; j <= top; ++j)
      f -= matrix(knots_.positions, knots_.normals, 0.0, static_cast<int>(j - m)) * weights.col(j);
    weights.col(m) = waves_.solve(f);
    rest -= matrix(knots_.positions, knots_.normals, k_, static_cast<int>(m)) * weights.col(m);
  }
  weights.col(0) = robin_.solve(rest);
  return weights;
}

Eigen::VectorXd BoundaryParticles::values(const Eigen::MatrixXd& weights, const Points& at) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(at.cols());
  for (Eigen::Index m = 0; m < weights.cols(); ++m)
    u += matrix(at, Points::Zero(3, at.cols()), 0.0, static_cast<int>(m)) * weights.col(m);
  return u;
}

LampLight::LampLight(double sigma) : sigma_(sigma), terms_{{{2, 0}, 1.0}} {}

// With R = r^-a exp(-sigma r) and H = mu^-b exp(sigma/mu),
//   R'' + 2 R'/r = (sigma^2 + 2 sigma (a-1)/r + a (a-1)/r^2) R,
//   ((1 - mu^2) H')' = (sigma^2 mu^-4 + 2 sigma (b+1) mu^-3 + (b (b+1) - sigma^2) mu^-2
//                       - 2 sigma b mu^-1 - b (b-1)) H.
LampLight LampLight::helmholtz(double lambda) const {
  const double s = sigma_, s2 = s * s;
  LampLight next(sigma_);
  next.terms_.clear();
  for (const auto& [powers, factor] : terms_) {
    const auto [i, j] = powers;
    const double a = i, b = j;
    next.terms_[{i, j}] += factor * (s2 - lambda * lambda);
    next.terms_[{i + 1, j}] += factor * 2.0 * s * (a - 1.0);
    next.terms_[{i + 2, j}] += factor * (a * (a - 1.0) - b * (b - 1.0));
    next.terms_[{i + 2, j + 1}] -= factor * 2.0 * s * b;
    next.terms_[{i + 2, j + 2}] += factor * (b * (b + 1.0) - s2);
    next.terms_[{i + 2, j + 3}] += factor * 2.0 * s * (b + 1.0);
    next.terms_[{i + 2, j + 4}] += factor * s2;
  }
  return next;
}

double LampLight::value(double r, double mu) const {
  double sum = 0.0;
  for (const auto& [powers, factor] : terms_)
    sum += factor * std::pow(r, -powers.first) * std::pow(mu, -powers.second);
  return sum * std::exp(-sigma_ * (r - 1.0 / mu));
}

// lap^m of it is a polynomial of degree m in q = r^2/h^2 over h^(2m), times it.
double gaussian_power(int m, double r_squared, double h, double lambda) {
  const double q = r_squared / (h * h), h2 = h * h, l2 = lambda * lambda;
  const double gauss = std::exp(-0.5 * q) * std::pow(2.0 * std::numbers::pi * h2, -1.5);
  const double lap1 = (q - 3.0) / h2;
  if (m == 0) return gauss;
  if (m == 1) return gauss * (lap1 - l2);
  const double lap2 = ((q - 10.0) * q + 15.0) / (h2 * h2);
  if (m == 2) return gauss * (lap2 - 2.0 * l2 * lap1 + l2 * l2);
  const double lap3 = (((q - 21.0) * q + 105.0) * q - 105.0) / (h2 * h2 * h2);
  return gauss * (lap3 - 3.0 * l2 * lap2 + 3.0 * l2 * l2 * lap1 - l2 * l2 * l2);
}

}  // namespace knotlight
