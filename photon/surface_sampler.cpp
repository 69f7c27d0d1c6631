#include "photon/surface_sampler.h"

#include <algorithm>
#include <cassert>

#include "core/sampling.h"

namespace knotlight {

SurfaceSampler::SurfaceSampler(const std::vector<std::pair<std::uint32_t, const Shape*>>& shapes) {
  double area_up_to = 0.0;
  for (const auto& [object, shape] : shapes) {
    const auto* mesh = std::get_if<TriangleMesh>(shape);
    if (mesh == nullptr) {
      pieces_.push_back({area_up_to += surface_area(*shape), object, shape, 0});
      continue;
    }
    for (const std::uint32_t t : morton_order(*mesh))
      pieces_.push_back({area_up_to += mesh->area(t), object, shape, t});
  }
}

SurfaceSampler::Point SurfaceSampler::operator()(double u, double v) const {
  assert(!pieces_.empty());
  const double target = u * area();
  const auto piece =
      std::upper_bound(pieces_.begin(), pieces_.end() - 1, target,
                       [](double value, const Piece& p) { return value < p.area_up_to; });
  const double before = piece == pieces_.begin() ? 0.0 : (piece - 1)->area_up_to;
  const double along = std::clamp((target - before) / (piece->area_up_to - before), 0.0, 1.0);
  if (const auto* sphere = std::get_if<Sphere>(piece->shape)) {
    const Vec3 n = sample_sphere(along, v);
    return {{sphere->center + sphere->radius * n, n}, piece->object};
  }
  const auto& mesh = std::get<TriangleMesh>(*piece->shape);
  const Eigen::Vector2d b = sample_triangle(along, v);
  const std::uint32_t t = piece->triangle;
  return {{(1.0 - b.x() - b.y()) * mesh.corner(t, 0) + b.x() * mesh.corner(t, 1) +
               b.y() * mesh.corner(t, 2),
           mesh.normal(t)},
          piece->object};
}

}  // namespace knotlight
