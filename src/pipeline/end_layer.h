// The ends of flights as what they are, a layer of charge just under the surface. Raised above it
// (photon_sources.h) they are no sources inside the body any more, and only Robin data can say that
// they are there: u + k du/dn = k times the layer's density.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bkm/point_sources.h"
#include "core/parallel.h"

namespace knotlight {

class EndLayer {
 public:
  // Of the charges that stand above their planes.
  EndLayer(const PointSources& sources, double lambda);

  // Charge per area at surface points (3 x N) with outward normals (3 x N). Each end is spread over
  // a disc twice as wide as it stands high, with a density that falls as a parabola: it integrates
  // to 1 on planes and, by Archimedes, on spheres.
  Eigen::VectorXd density(const Points& x, const Points& normals, const Workers& workers) const;

 private:
  struct End {
    std::uint64_t cell;
    Vec3 position, normal;
    double strength;
  };
  std::uint64_t cell_of(const Vec3& x, int dx, int dy, int dz) const;
  double density_at(const Vec3& x, const Vec3& normal) const;

  double radius_ = 0.0;
  Vec3 lo_ = Vec3::Zero();
  std::vector<End> ends_;  // by cell
};

}  // namespace knotlight
