#include "bkm/knots.h"

#include <cassert>
#include <cmath>

namespace knotlight {

InteriorKnots interior_knots(const Points& boundary_points, const Points& boundary_normals,
                             const std::vector<double>& depths,
                             const std::function<bool(const Vec3&)>& inside) {
  assert(boundary_points.cols() == boundary_normals.cols());
  const Eigen::Index count = boundary_points.cols();
  Points kept(3, count * static_cast<Eigen::Index>(depths.size()));
  InteriorKnots knots;
  Eigen::Index used = 0;
  for (const double depth : depths)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vec3 candidate = boundary_points.col(i) - depth * boundary_normals.col(i);
      if (inside(candidate))
        kept.col(used++) = candidate;
      else
        ++knots.dropped;
    }
  knots.points = kept.leftCols(used);
  return knots;
}

double mean_knot_spacing(double area, std::size_t knots) {
  assert(knots > 0);
  return std::sqrt(area / static_cast<double>(knots));
}

double default_shape_parameter() {
  return 8.0;
}

}  // namespace knotlight
