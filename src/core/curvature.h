// Mean curvature of a surface, as light in the medium below feels it: over a length.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shape.h"

namespace knotlight {

// Mean curvature (half the sum of both principal ones, 1/length, positive where the body is
// convex), averaged over about `scale` (length) around each place. A sphere: 1/radius. A mesh: by
// the angles at its edges [CM03], smoothed over the surface.
class SurfaceCurvature {
 public:
  SurfaceCurvature(const Shape& shape, double scale);

  // Half of the surface is bent less.
  double median() const { return median_; }
  // Mean over a triangle (of a sphere: anything).
  double at(std::uint32_t primitive) const;
  // In a triangle at the barycentric coordinates of its corners 1 and 2.
  double at(std::uint32_t primitive, double b1, double b2) const;

 private:
  const TriangleMesh* mesh_ = nullptr;  // borrowed from the shape; null for a sphere
  double median_ = 0.0;
  std::vector<double> at_vertices_;
};

}  // namespace knotlight
