#include "grid/error_estimate.h"

#include <cmath>

namespace knotlight {
namespace {

constexpr double assumed_order = 1.5;

}  // namespace

GridErrorEstimate estimate_error(const GridField& fine, const GridField& coarse,
                                 const Points& points, const Points& normals) {
  const Eigen::VectorXd u = fine.values(points, normals);
  const Eigen::VectorXd difference = u - coarse.values(points, normals);
  GridErrorEstimate estimate;
  if (u.size() == 0) return estimate;
  const double order = std::pow(2.0, assumed_order) - 1.0;
  estimate.scale = u.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  // A dark object is exact.
  if (estimate.scale == 0.0 && difference.isZero(0.0)) return estimate;
  estimate.rms =
      difference.norm() / std::sqrt(static_cast<double>(u.size())) / order / estimate.scale;
  estimate.largest = difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / order / estimate.scale;
  return estimate;
}

}  // namespace knotlight
