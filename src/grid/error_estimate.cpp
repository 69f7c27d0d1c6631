#include "grid/error_estimate.h"

#include <cmath>

namespace knotlight {
namespace {

// Somewhat below what is seen: 1.5 (bunny) to 2.5 in 60 random scenes, seldom below 1.7
// (docs/results/estimates.md).
constexpr double assumed_order = 1.3;
// Where light decays within a cell the coarse grid is as good as blind, and the difference no
// longer grows as the order says: 1.26 was seen with cells as large as 1.14 / lambda.
constexpr double loss_of_order = 0.3;  // per squared cell size in units of 1/lambda

}  // namespace

GridErrorEstimate estimate_error(const GridField& fine, const GridField& coarse,
                                 const Points& points, const Points& normals,
                                 double cell_in_decay_lengths) {
  const Eigen::VectorXd u = fine.values(points, normals);
  const Eigen::VectorXd difference = u - coarse.values(points, normals);
  GridErrorEstimate estimate;
  if (u.size() == 0) return estimate;
  const double order =
      assumed_order / (1.0 + loss_of_order * cell_in_decay_lengths * cell_in_decay_lengths);
  const double difference_over_error = std::pow(2.0, order) - 1.0;
  estimate.scale = u.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  // A dark object is exact.
  if (estimate.scale == 0.0 && difference.isZero(0.0)) return estimate;
  estimate.rms = difference.norm() / std::sqrt(static_cast<double>(u.size())) /
                 difference_over_error / estimate.scale;
  estimate.largest = difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / difference_over_error /
                     estimate.scale;
  return estimate;
}

}  // namespace knotlight
