#include "core/surface_layer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/fresnel.h"

namespace knotlight {
namespace {

// Cells in depth, finest at the surface, where q has a logarithm; 9 mean free paths down the layer
// has decayed to 1e-4. Doubling both changes q by less than 1e-3.
constexpr int cells = 160;
constexpr double deepest = 9.0;
constexpr double grading = 2.5;
// Where the deviation from the asymptote is required to vanish: deep enough, and away from the end.
constexpr double matched_at = 0.6;
// Points in the cosine, below and above the critical one.
constexpr int cosines = 48;
constexpr double hopf_at_infinity = 0.710446;
// A surface that is hollow by more than this is a plane at no scale that light feels.
constexpr double least_bend = 0.5;

// Midpoint rules in t with mu = mu_c t^2 below the critical cosine and mu_c + (1 - mu_c) t^2 above
// it: exp(-tau / mu) is rough at 0, the reflectance has a square root at mu_c.
struct Cosine {
  double mu, weight, reflectance;
};
std::vector<Cosine> cosine_rule(double ior) {
  const double critical = ior > 1.0 ? std::sqrt(1.0 - 1.0 / (ior * ior)) : 0.0;
  std::vector<Cosine> rule;
  for (int i = 0; i < cosines; ++i) {
    const double t = (i + 0.5) / cosines;
    for (const auto& [begin, length] :
         {std::pair(0.0, critical), std::pair(critical, 1.0 - critical)}) {
      const double mu = begin + length * t * t;
      if (length > 0.0)
        rule.push_back({mu, 2.0 * t * length / cosines, fresnel_reflectance(mu, 1.0 / ior)});
    }
  }
  return rule;
}

}  // namespace

// With U = tau + q(inf) + delta(tau), (I - K) delta = b - q(inf) a, where
//   K = 1/2 int (exp(-|tau - tau'| / mu) + R exp(-(tau + tau') / mu)) dmu / mu,
//   a = 1/2 int (1 - R) exp(-tau / mu) dmu,   b = 1/2 int (1 + R) mu exp(-tau / mu) dmu,
// in means over cells; q(inf) makes delta vanish far below.
SurfaceLayer::SurfaceLayer(double ior) {
  const std::vector<Cosine> rule = cosine_rule(ior);
  const auto m = static_cast<Eigen::Index>(rule.size());
  Eigen::VectorXd edge(cells + 1);
  for (int i = 0; i <= cells; ++i)
    edge[i] = deepest * std::pow(static_cast<double>(i) / cells, grading);
  const Eigen::VectorXd h = edge.tail(cells) - edge.head(cells);

  Eigen::MatrixXd passed(cells + 1, m);  // exp(-edge / mu)
  Eigen::VectorXd mu(m), weight(m), R(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    mu[j] = rule[static_cast<std::size_t>(j)].mu;
    weight[j] = rule[static_cast<std::size_t>(j)].weight;
    R[j] = rule[static_cast<std::size_t>(j)].reflectance;
    passed.col(j) = (-edge.array() / mu[j]).exp();
  }
  const Eigen::MatrixXd absorbed = passed.topRows(cells) - passed.bottomRows(cells);

  // int_i int_j of the kernel over both cells; within a cell int int exp(-|x-y|/mu)/mu =
  // 2 (h - mu (1 - exp(-h/mu))).
  Eigen::MatrixXd K = 0.5 * absorbed *
                      (weight.array() * R.array() * mu.array()).matrix().asDiagonal() *
                      absorbed.transpose();
  for (int i = 0; i < cells; ++i) {
    const Eigen::ArrayXd leaving = 1.0 - (-h[i] / mu.array()).exp();
    K(i, i) += (weight.array() * (h[i] - mu.array() * leaving)).sum();
    for (int j = i + 1; j < cells; ++j) {
      const Eigen::ArrayXd arriving = 1.0 - (-h[j] / mu.array()).exp();
      const double part = 0.5 * (weight.array() * mu.array() * leaving * arriving *
                                 (-(edge[j] - edge[i + 1]) / mu.array()).exp())
                                    .sum();
      K(i, j) += part;
      K(j, i) += part;
    }
  }
  const Eigen::VectorXd a =
      0.5 * absorbed * (weight.array() * (1.0 - R.array()) * mu.array()).matrix();
  const Eigen::VectorXd b =
      0.5 * absorbed * (weight.array() * (1.0 + R.array()) * mu.array().square()).matrix();
  Eigen::MatrixXd system = -K;
  system.diagonal() += h;
  Eigen::MatrixXd sources(cells, 2);
  sources << a, b;
  const Eigen::MatrixXd deviation = system.partialPivLu().solve(sources);
  int match = 0;
  while (edge[match] < matched_at * deepest) ++match;
  const double at_infinity = deviation(match, 1) / deviation(match, 0);
  for (int i = 0; i <= match; ++i) {
    tau_.push_back(0.5 * (edge[i] + edge[i + 1]));
    q_.push_back(at_infinity + deviation(i, 1) - at_infinity * deviation(i, 0));
  }
  q_.back() = at_infinity;
}

double SurfaceLayer::q(double tau) const {
  if (tau >= tau_.back()) return q_.back();
  if (tau <= tau_.front()) return q_.front();
  const auto above = std::upper_bound(tau_.begin(), tau_.end(), tau) - tau_.begin();
  const auto i = static_cast<std::size_t>(above) - 1;
  const double part = (tau - tau_[i]) / (tau_[i + 1] - tau_[i]);
  return (1.0 - part) * q_[i] + part * q_[i + 1];
}

double SurfaceLayer::weight(double tau, double k, double excess_curvature) const {
  if (std::isinf(tau)) return 1.0;
  tau = std::max(tau, 0.0);
  const double bend = std::max(k * hopf_at_infinity * excess_curvature, (least_bend - 1.0) * k);
  return (tau + k - extrapolation() + q(tau)) / std::sqrt((tau + k) * (tau + k + bend));
}

double bent_extrapolation(double k, double curvature) {
  return k / std::max(1.0 + hopf_at_infinity * curvature, least_bend);
}

}  // namespace knotlight
