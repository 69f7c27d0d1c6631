#include "bkm/certificate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace knotlight {
namespace {

// Knots and check points lie on the body but need not touch its outermost parts: with a hundred of
// them or more the ball around them misses less than a twentieth of the radius of a smooth body.
constexpr double radius_margin = 1.05;

// Eigen's maxCoeff and norm may lose NaN; these keep it.
double largest(const Eigen::VectorXd& v) {
  double m = 0.0;
  for (const double x : v) {
    if (std::isnan(x)) return x;
    m = std::max(m, std::abs(x));
  }
  return m;
}

double rms(const Eigen::VectorXd& v) {
  return v.size() == 0 ? 0.0 : std::sqrt(v.squaredNorm() / static_cast<double>(v.size()));
}

// Radius of a ball around the body: about the middle of the box of its known surface points.
double enclosing_radius(const Points& knots, const Points& checks) {
  Points surface(3, knots.cols() + checks.cols());
  surface << knots, checks;
  const Vec3 middle = 0.5 * (surface.rowwise().minCoeff() + surface.rowwise().maxCoeff());
  return radius_margin * std::sqrt((surface.colwise() - middle).colwise().squaredNorm().maxCoeff());
}

// A field that is all error would call itself 100 % off if measured against its own size.
double relative_error(double bound, double scale) {
  if (!std::isfinite(bound) || !std::isfinite(scale))
    return std::numeric_limits<double>::quiet_NaN();
  if (bound == 0.0) return 0.0;
  return bound < scale ? bound / (scale - bound) : std::numeric_limits<double>::infinity();
}

}  // namespace

double source_gain(double lambda, double k, double enclosing_radius) {
  const double by_size = enclosing_radius * (enclosing_radius + 2.0 * k) / 6.0;
  const double by_absorption = 1.0 / (lambda * lambda);
  return by_absorption < by_size ? by_absorption : by_size;
}

Certificate certify(const BkmField& field, const BkmThesisProblem& problem,
                    const Points& boundary_points, const Points& boundary_normals,
                    const Eigen::VectorXd& g, const Points& interior_points,
                    const Eigen::VectorXd& f) {
  const Eigen::Index on_boundary = boundary_points.cols();
  const Eigen::Index inside = interior_points.cols();
  assert(on_boundary >= 1 && boundary_normals.cols() == on_boundary && g.size() == on_boundary);
  assert(f.size() == inside);

  Eigen::VectorXd rho(on_boundary);
  Eigen::VectorXd u(on_boundary + inside);
  for (Eigen::Index i = 0; i < on_boundary; ++i) {
    const Vec3 x = boundary_points.col(i);
    rho(i) = g(i) - field.robin(x, boundary_normals.col(i), problem.k);
    u(i) = field.value(x);
  }
  Eigen::VectorXd left(inside);  // f - f~
  for (Eigen::Index i = 0; i < inside; ++i) {
    const Vec3 x = interior_points.col(i);
    left(i) = f(i) - field.source(x);
    u(on_boundary + i) = field.value(x);
  }

  Certificate c;
  c.robin_residual_rms = rms(rho);
  c.robin_residual_max = largest(rho);
  c.source_residual_rms = rms(left);
  c.source_residual_max = largest(left);
  c.gain = source_gain(problem.lambda, problem.k,
                       enclosing_radius(problem.boundary_points, boundary_points));
  c.error_bound = c.robin_residual_max + c.gain * c.source_residual_max;
  c.scale = largest(u);
  c.trusted = std::isfinite(c.error_bound) && std::isfinite(c.scale);
  c.error_estimate = relative_error(c.error_bound, c.scale);
  return c;
}

}  // namespace knotlight
