#include "bkm/field.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace knotlight {
namespace {

// sum_j weight_j kernel(s_j), batch after batch.
template <typename Kernel>
double weighted_sum(const PointColumns& points, const Eigen::VectorXd& weights, const Vec3& x,
                    DistancePrecision precision, const Kernel& kernel) {
  double sum = 0.0;
  for (Eigen::Index first = 0; first < weights.size(); first += batch_size) {
    const Eigen::Index n = std::min(batch_size, weights.size() - first);
    const Batch w = kernel(squared_distances(points, first, n, x, precision));
    sum += (w * weights.segment(first, n).array()).sum();
  }
  return sum;
}

struct ValueAndGradient {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
};

// The same for values and gradients.
void add_with_gradient(const PointColumns& points, const Eigen::VectorXd& weights, const Vec3& x,
                       DistancePrecision precision, const RadialFunction& function,
                       ValueAndGradient& sum) {
  for (Eigen::Index first = 0; first < weights.size(); first += batch_size) {
    const Eigen::Index n = std::min(batch_size, weights.size() - first);
    const RadialBatch w =
        psi_with_slopes(function, squared_distances(points, first, n, x, precision));
    const Batch weight = weights.segment(first, n).array();
    sum.value += (w.value * weight).sum();
    const Batch pull = w.slope * weight;
    for (int axis = 0; axis < 3; ++axis)
      sum.gradient(axis) += (pull * (x(axis) - points.col(axis).segment(first, n))).sum();
  }
}

ValueAndGradient value_and_gradient(const BkmBasis& basis, const Eigen::VectorXd& alpha,
                                    const Eigen::VectorXd& beta, const Vec3& x) {
  ValueAndGradient sum;
  add_with_gradient(basis.centers, alpha, x, basis.precision, basis.particular, sum);
  add_with_gradient(basis.knots, beta, x, basis.precision, basis.homogeneous, sum);
  return sum;
}

}  // namespace

BkmField::BkmField(BkmBasis basis, Eigen::VectorXd alpha, Eigen::VectorXd beta)
    : basis_(std::move(basis)), alpha_(std::move(alpha)), beta_(std::move(beta)) {
  assert(alpha_.size() == 0 || alpha_.size() == basis_.centers.rows());
  assert(beta_.size() == 0 || beta_.size() == basis_.knots.rows());
}

double BkmField::value(const Vec3& x) const {
  return weighted_sum(basis_.centers, alpha_, x, basis_.precision,
                      [&](const Batch& s) { return psi_values(basis_.particular, s); }) +
         weighted_sum(basis_.knots, beta_, x, basis_.precision,
                      [&](const Batch& s) { return psi_values(basis_.homogeneous, s); });
}

Vec3 BkmField::gradient(const Vec3& x) const {
  return value_and_gradient(basis_, alpha_, beta_, x).gradient;
}

double BkmField::robin(const Vec3& x, const Vec3& n, double k) const {
  const ValueAndGradient u = value_and_gradient(basis_, alpha_, beta_, x);
  return u.value + k * u.gradient.dot(n);
}

double BkmField::source(const Vec3& x) const {
  const double f = weighted_sum(basis_.centers, alpha_, x, basis_.precision,
                                [&](const Batch& s) { return phi_values(basis_.particular, s); });
  if (basis_.homogeneous.order == 0) return f;
  return f + weighted_sum(basis_.knots, beta_, x, basis_.precision,
                          [&](const Batch& s) { return phi_values(basis_.homogeneous, s); });
}

Eigen::VectorXd BkmField::values(const Points& x) const {
  Eigen::VectorXd u(x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) u(i) = value(x.col(i));
  return u;
}

}  // namespace knotlight
