#include "chart/error_parts.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

// Root of a - b, both squared, 0 if b is larger; not-a-number stays.
double without(double a, double b) {
  const double square = a * a - b * b;
  return std::sqrt(square < 0.0 ? 0.0 : square);
}

}  // namespace

ErrorParts error_parts(const std::vector<Eigen::VectorXd>& values, const Eigen::VectorXd& truth,
                       double truth_noise, const Eigen::VectorXd& converged,
                       const RelativeRms& error) {
  ErrorParts result;
  if (values.empty()) return result;
  const auto n = static_cast<double>(values.size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(truth.size());
  double squares = 0.0;
  for (const Eigen::VectorXd& value : values) {
    mean += value / n;
    squares += std::pow(error(value, truth), 2) / n;
  }
  // A mean of squares is known to a relative sqrt(2 / size) (normal distribution); twice that of
  // the truth's own noise could hide an error, which is then said as large as it may be.
  const double hidden =
      truth_noise * std::sqrt(2.0 * std::sqrt(2.0 / static_cast<double>(truth.size())));
  result.error = std::max(without(std::sqrt(squares), truth_noise), hidden);
  if (values.size() > 1) {
    double spread = 0.0;
    for (const Eigen::VectorXd& value : values)
      spread += std::pow(error(Eigen::VectorXd(value - mean + truth), truth), 2);
    result.noise = std::sqrt(spread / (n - 1.0));
  }
  if (converged.size() == 0) return result;
  result.numerical = without(error(mean, converged), result.noise / std::sqrt(n));
  result.model = std::max(without(error(converged, truth), truth_noise), hidden);
  return result;
}

}  // namespace knotlight
