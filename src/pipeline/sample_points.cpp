#include "pipeline/sample_points.h"

#include "core/rng.h"

namespace knotlight {

SurfaceSamples columns(const std::vector<SurfacePoint>& points) {
  const auto n = static_cast<Eigen::Index>(points.size());
  SurfaceSamples samples{Points(3, n), Points(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    samples.positions.col(i) = points[static_cast<std::size_t>(i)].position;
    samples.normals.col(i) = points[static_cast<std::size_t>(i)].normal;
  }
  return samples;
}

Points volume_points(const Shape& shape, const RayCaster& caster, std::uint32_t object,
                     std::size_t count, std::uint64_t seed) {
  const Bounds box = bounds(shape);
  Points points(3, static_cast<Eigen::Index>(count));
  Rng rng(seed, Stream::volume_points, object);
  for (Eigen::Index i = 0; i < points.cols();) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    const Vec3 p = box.lo + Vec3(x, y, rng.uniform()).cwiseProduct(box.hi - box.lo);
    if (caster.inside(p, object)) points.col(i++) = p;
  }
  return points;
}

}  // namespace knotlight
