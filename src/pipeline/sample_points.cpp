#include "pipeline/sample_points.h"

#include "core/rng.h"

namespace knotlight {
namespace {

constexpr std::size_t most_tries =
    200;  // per point; about a second for an object that is hardly there

}  // namespace

Points volume_points(const Shape& shape, const RayCaster& caster, std::uint32_t object,
                     std::size_t count, std::uint64_t seed) {
  const Bounds box = bounds(shape);
  Points points(3, static_cast<Eigen::Index>(count));
  Rng rng(seed, Stream::volume_points, object);
  Eigen::Index found = 0;
  for (std::size_t tries = 0; found < points.cols() && tries < most_tries * count; ++tries) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    const Vec3 p = box.lo + Vec3(x, y, rng.uniform()).cwiseProduct(box.hi - box.lo);
    if (caster.inside(p, object)) points.col(found++) = p;
  }
  return points.leftCols(found);
}

}  // namespace knotlight
