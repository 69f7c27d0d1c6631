// Nodes on an object's surface at which the field is evaluated once, and the interpolation between
// them that every pixel uses.
#pragma once

#include <Eigen/Core>

#include "core/shape.h"
#include "trace/ray_caster.h"

namespace knotlight {

class SurfaceGrid {
 public:
  // Mesh: the nodes are its vertices (the scene reader has refined coarse ones), interpolation is
  // linear on each triangle. Sphere: a cube projected onto it, cells x cells per face, bilinear.
  explicit SurfaceGrid(const Shape& shape, int cells = 64);

  const Points& nodes() const { return nodes_; }
  // The value at a hit on this shape of a field given at the nodes (one per node).
  double interpolate(const Eigen::VectorXd& values, const Hit& hit) const;

 private:
  const TriangleMesh* mesh_;  // borrowed from the shape; null for a sphere
  Vec3 center_ = Vec3::Zero();
  int cells_ = 0;
  Points nodes_;
};

}  // namespace knotlight
