// Bodies given by formulas: their surface, what is inside and how far away it is, all exact.
#pragma once

#include <functional>
#include <string>

#include "bkm/patch_tree.h"
#include "core/shape.h"

namespace knotlight {

struct Body {
  std::string name;
  double half_extent = 1.0;  // R of lambda R, half of the longest side of the box around it, length
  double area = 0.0;         // length^2
  // Equal areas of the unit square go to equal areas of the surface.
  std::function<SurfacePoint(double u, double v)> point;
  std::function<double(const Vec3&)> depth;  // distance from the surface, negative outside, length
  Shape shape;        // for methods that want one; the mesh of the torus is off by 3e-4 of its size
  SurfacePoint foot;  // above which the sources of exact solutions stand
};

Body unit_ball();
// Circle of radius 1, tube of radius 0.35.
Body thin_torus();

// `count` points, evenly spread, as is every prefix: the additive sequence of the plastic number
// [R18], the golden ratio's analogue in two dimensions.
SpreadKnots spread_over(const Body& body, std::size_t count);

// The questions of the local method, answered by steps as long as the distance to the surface.
BodyQueries queries(const Body& body);

}  // namespace knotlight
