// Planes in which the charges of a body are mirrored, and how far above them the outside is free.
#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "core/shape.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct TangentPlane {
  Vec3 point;                   // of the surface, nearest to what is mirrored
  Vec3 normal;                  // outward unit normal
  std::uint32_t primitive = 0;  // triangle of a mesh
};

class TangentPlanes {
 public:
  // k > 0: length, of the Robin condition: images reach some k out of the surface, and facets much
  // smaller than k are taken for what they stand for, a curved surface.
  TangentPlanes(const Shape& shape, const RayCaster& caster, std::uint32_t object, double k);

  // At the point of the surface nearest to p.
  TangentPlane nearest_to(const Vec3& p) const;

  // One height per plane, up to 8 k: as far as it a charge above the plane's point stays clear of
  // the rest of the surface. Planes within k/2 of each other on the same triangle share the lowest
  // index's. Same values for any number of workers.
  std::vector<double> clear_heights(const std::vector<TangentPlane>& planes,
                                    const Workers& workers) const;

 private:
  double clear_height(const TangentPlane& plane) const;

  const Shape& shape_;
  const RayCaster& caster_;
  std::uint32_t object_;
  double k_;
  std::vector<Vec3> corner_normals_;  // of a mesh, 3 per triangle
};

}  // namespace knotlight
