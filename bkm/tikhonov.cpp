#include "bkm/tikhonov.h"

#include <cassert>
#include <cmath>

#include "core/not_finite.h"

namespace knotlight {
namespace {

// Values of mu looked at, evenly in log mu over up to 16 decades: 25 a decade, and mu need not be
// known better than to some per cent.
constexpr int steps = 400;

double at_step(const DataSpectrum& data, int i) {
  const double lo = std::log(data.s(data.s.size() - 1)), hi = std::log(data.s(0));
  return std::exp(lo + (hi - lo) * i / (steps - 1.0));
}

bool usable(const DataSpectrum& data) {
  assert(data.s.size() == data.coefficients.size() && data.rows >= data.s.size());
  return data.s.size() > 0 && data.coefficients.allFinite() && !std::isnan(data.outside_squared);
}

Eigen::ArrayXd filters(const DataSpectrum& data, double mu) {
  const Eigen::ArrayXd squares = data.s.array().square();
  return squares / (squares + mu * mu);
}

}  // namespace

double gcv_regulariser(const DataSpectrum& data) {
  if (!usable(data)) return nan;
  double best = nan, least = infinity;
  for (int i = 0; i < steps; ++i) {
    const double mu = at_step(data, i);
    const Eigen::ArrayXd f = filters(data, mu);
    const double residual =
        ((1.0 - f) * data.coefficients.array()).square().sum() + data.outside_squared;
    const double freedom = static_cast<double>(data.rows) - f.sum();
    const double value = residual / (freedom * freedom);
    // Of equals the largest mu: data that are zero are damped most.
    if (value <= least) {
      least = value;
      best = mu;
    }
  }
  return best;
}

// With t = log mu: df/dt = -2 f (1 - f), so the direction (d log|r|, d log|x|)/dt has a closed form
// and only its turning is differenced.
double l_curve_regulariser(const DataSpectrum& data) {
  if (!usable(data)) return nan;
  double best = at_step(data, 0), sharpest = -infinity;
  double before_angle = 0.0, before_x = 0.0, before_y = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double mu = at_step(data, i);
    const Eigen::ArrayXd f = filters(data, mu);
    const Eigen::ArrayXd c2 = data.coefficients.array().square();
    const Eigen::ArrayXd x2 = (f / data.s.array()).square() * c2;
    const double residual = ((1.0 - f).square() * c2).sum() + data.outside_squared;
    const double size = x2.sum();
    if (!(residual > 0.0) || !(size > 0.0)) continue;  // no logarithm, no corner
    const double x = 0.5 * std::log(residual), y = 0.5 * std::log(size);
    const double dx = 2.0 * (f * (1.0 - f).square() * c2).sum() / residual;
    const double dy = -2.0 * ((1.0 - f) * x2).sum() / size;
    const double angle = std::atan2(dy, dx);  // -pi/2 on the steep branch, 0 on the flat one
    const double arc = std::hypot(x - before_x, y - before_y);
    const double curvature = (angle - before_angle) / arc;
    if (i > 0 && arc > 0.0 && curvature > sharpest) {
      sharpest = curvature;
      best = mu;
    }
    before_angle = angle;
    before_x = x;
    before_y = y;
  }
  return best;
}

}  // namespace knotlight
