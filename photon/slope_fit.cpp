#include "photon/slope_fit.h"

#include <cmath>
#include <limits>

namespace knotlight {
namespace {

// Fewer photons do not tell a slope in three directions from noise.
constexpr std::size_t fewest_photons = 16;
// Newton steps; from b = 0 it takes 3 to 5 unless no exponential fits.
constexpr int most_steps = 12;
// Of the radius: what is left between the carried photons' centroid and the kernel's. The value
// errs by this times b . m, far below the noise of the photons.
constexpr double centroid_tolerance = 1e-4;
// Longest step and steepest slope, per radius of the ball: an exponential that changes by more than
// e^8 over the ball is a shadow's edge or an empty side, not a slope.
constexpr double longest_step = 2.0;
constexpr double steepest = 8.0;

// The photons' total, centroid and covariance, each carried by exp(-b.u).
struct Carried {
  double sum = 0.0;
  Vec3 mean = Vec3::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};
Carried carried(const LocalPhotons& photons, const Vec3& b) {
  Carried c;
  for (std::size_t i = 0; i < photons.offsets.size(); ++i) {
    const Vec3& u = photons.offsets[i];
    const double t = photons.weights[i] * std::exp(-b.dot(u));
    c.sum += t;
    c.mean += t * u;
    c.covariance += t * u * u.transpose();
  }
  c.mean /= c.sum;
  c.covariance = c.covariance / c.sum - c.mean * c.mean.transpose();
  return c;
}

}  // namespace

double carry_along_slope(LocalPhotons& photons, const Vec3& centroid) {
  if (photons.offsets.size() < fewest_photons) return relative_error_of_sum(photons.weights);
  Vec3 b = Vec3::Zero();
  for (int step = 0; step < most_steps; ++step) {
    const Carried c = carried(photons, b);
    const Vec3 downhill = c.mean - centroid;
    const Eigen::LDLT<Eigen::Matrix3d> hessian(c.covariance);
    if (hessian.info() != Eigen::Success || !hessian.isPositive()) break;
    if (downhill.norm() < centroid_tolerance) {
      // log rho(x) = log sum - b.m: photon i moves the first by its part of the sum, b by the
      // inverse Hessian times that part of the centroid.
      const Vec3 pull = hessian.solve(centroid);
      double variance = 0.0;
      for (std::size_t i = 0; i < photons.offsets.size(); ++i) {
        double& weight = photons.weights[i];
        weight *= std::exp(-b.dot(photons.offsets[i]));
        const double influence = weight / c.sum * (1.0 - pull.dot(photons.offsets[i] - centroid));
        variance += influence * influence;
      }
      return std::sqrt(variance);
    }
    Vec3 change = hessian.solve(downhill);
    if (change.norm() > longest_step) change *= longest_step / change.norm();
    b += change;
    if (!(b.norm() < steepest)) break;
  }
  return relative_error_of_sum(photons.weights);
}

double relative_error_of_sum(const std::vector<double>& weights) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double w : weights) {
    sum += w;
    squares += w * w;
  }
  return weights.empty() ? std::numeric_limits<double>::infinity() : std::sqrt(squares) / sum;
}

}  // namespace knotlight
