#include "photon/depth_rule.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace knotlight {
namespace {

constexpr int largest_rule = 8;

// Beyond this depth the light that is left adds less than 1e-20 to the moments of the largest rule:
// the ray is endless to rounding.
constexpr double endless = 100.0;

// Points that resolve exp(-t) times a polynomial of degree 15 over the longest interval.
constexpr int fine_points = 64;

struct Rule {
  Eigen::VectorXd nodes, weights;
};

// Nodes and weights from the three-term recurrence of the orthogonal polynomials: eigenvalues, and
// first components of the eigenvectors, of the Jacobi matrix [GW69].
Rule golub_welsch(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                  double total) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal, off_diagonal);
  return {eigen.eigenvalues(), total * eigen.eigenvectors().row(0).transpose().array().square()};
}

// Gauss-Legendre on (0, 1).
const Rule& legendre() {
  static const Rule rule = [] {
    Eigen::VectorXd off(fine_points - 1);
    for (int i = 1; i < fine_points; ++i) off[i - 1] = 0.5 * i / std::sqrt(4.0 * i * i - 1.0);
    return golub_welsch(Eigen::VectorXd::Constant(fine_points, 0.5), off, 1.0);
  }();
  return rule;
}

// The recurrence of the weight exp(-t) on (0, tau) by Stieltjes' procedure on fine points.
Rule gauss_rule(double tau, int m) {
  const Eigen::ArrayXd t = tau * legendre().nodes.array();
  const Eigen::ArrayXd w = tau * legendre().weights.array() * (-t).exp();
  const double total = -std::expm1(-tau);
  Eigen::VectorXd diagonal(m);
  Eigen::VectorXd off(m - 1);
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(fine_points);
  Eigen::ArrayXd now = Eigen::ArrayXd::Ones(fine_points) / std::sqrt(w.sum());
  double b = 0.0;
  for (int k = 0; k < m; ++k) {
    diagonal[k] = (w * t * now.square()).sum();
    if (k + 1 == m) break;
    Eigen::ArrayXd next = (t - diagonal[k]) * now - b * before;
    b = std::sqrt((w * next.square()).sum());
    off[k] = b;
    before = now;
    now = next / b;
  }
  return golub_welsch(diagonal, off, total);
}

}  // namespace

void stratified_depths(double tau, int m, double offset, std::vector<DepthPoint>& out) {
  out.clear();
  const double interacting = -std::expm1(-tau);
  for (int i = 0; i < m; ++i) {
    const double u = (i + offset) / m;
    out.push_back({std::min(tau, -std::log1p(-u * interacting)), interacting / m});
  }
}

void gauss_depths(double tau, int m, std::vector<DepthPoint>& out) {
  assert(m >= 1 && m <= largest_rule);
  static const std::vector<Rule> endless_rules = [] {
    std::vector<Rule> rules;
    for (int i = 1; i <= largest_rule; ++i) rules.push_back(gauss_rule(endless, i));
    return rules;
  }();
  const Rule& rule =
      tau >= endless ? endless_rules[static_cast<std::size_t>(m - 1)] : gauss_rule(tau, m);
  out.clear();
  for (int i = 0; i < m; ++i) out.push_back({std::clamp(rule.nodes[i], 0.0, tau), rule.weights[i]});
}

}  // namespace knotlight
