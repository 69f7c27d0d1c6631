// Point charges whose field is a particular solution: -lap u + lambda^2 u = sum q_s delta(x - y_s)
// gives u = sum q_s exp(-lambda r)/(4 pi r).
#pragma once

#include <Eigen/Core>

#include "core/vec3.h"

namespace knotlight {

// S charges inside a body or on its surface. A charge on the surface counts as one just inside: it
// must have at least the mirror charge, which carries one half of what its normal derivative would
// be there.
struct PointSources {
  Points positions;           // 3 x S, length
  Eigen::VectorXd strengths;  // S; W/(length sr) for U_d
  Points plane_points;        // 3 x S, on the plane of the Robin image, length
  Points plane_normals;       // 3 x S, outward unit normals
  // S: height above the plane up to which there is room for image charges (robin_image.h), length;
  // infinite: everywhere; negative: no image. What lies outside the body has no source inside, so
  // that any image may be used there; what it leaves undone is left to the boundary solve.
  Eigen::VectorXd clear_heights;

  Eigen::Index size() const { return positions.cols(); }
};

}  // namespace knotlight
