#include "compare/figures.h"

#include <algorithm>
#include <cmath>

#include "pipeline/channel_problem.h"

namespace knotlight {

double relative_rms(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                    const Eigen::VectorXd& weights) {
  const Eigen::VectorXd w = weights.size() > 0 ? weights : Eigen::VectorXd::Ones(b.size());
  return std::sqrt(relative((w.array() * (a - b).array().square()).sum(),
                            (w.array() * b.array().square()).sum()));
}

double relative_rms_beyond_noise(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                 const Eigen::VectorXd& b_error) {
  const double noise = b_error.squaredNorm();
  const double difference = (a - b).squaredNorm() - noise;
  // b's own square holds its noise too. Comparisons that leave not-a-number as it is.
  return std::sqrt(relative(difference < 0.0 ? 0.0 : difference, b.squaredNorm() - noise));
}

double luminance(const Spectrum& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

}  // namespace knotlight
