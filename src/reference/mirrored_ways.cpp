// Mirror images [Bo84]: what a plane mirrors comes from the image of the inner point behind it, as
// if straight, so that the refraction on the way in is that of a way to the image.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "reference/refracted_ways.h"

namespace knotlight {
namespace {

double distance(const Bounds& box, const Vec3& p) {
  return (p - p.cwiseMax(box.lo).cwiseMin(box.hi)).norm();
}

}  // namespace

struct RefractingSurface::MirrorSearch {
  const Plane& entry;  // by which light comes in
  const LightPlace& light;
  double sigma_t, reach;  // ways that have to be longer than `reach` are left out
  Rng& rng;
  std::vector<RefractedWay>& ways;
  std::array<Vec3, most_mirrors> normals;
};

void RefractingSurface::find_mirrored(const Vec3& p, const LightPlace& light, double sigma_t,
                                      Rng& rng, std::vector<RefractedWay>& ways) const {
  const double u = rng.uniform();
  const double reach =
      sigma_t > 0.0 ? sample_free_flight(u, sigma_t) : std::numeric_limits<double>::infinity();
  for (const Plane& entry : planes_) {
    if (height_over_plane(entry.facet.a, entry.facet.normal, light) <= 0.0) continue;
    MirrorSearch search{entry, light, sigma_t, reach, rng, ways, {}};
    mirror(p, 0, 0.0, search);
  }
}

// least: a lower bound of the lengths of ways to this image. Where they cross the surface they are
// in front of all their mirrors, so that further images are further away.
void RefractingSurface::mirror(const Vec3& image, int mirrors, double least,
                               MirrorSearch& search) const {
  for (const Plane& plane : planes_) {
    const Vec3& normal = plane.facet.normal;
    const double depth = (plane.facet.a - image).dot(normal);
    if (depth <= 0.0) continue;  // what comes from there meets this mirror from behind
    const Vec3 next = image + 2.0 * depth * normal;
    const double length = std::max(least, distance(search.entry.bounds, next));
    if (length > search.reach) continue;
    search.normals[static_cast<std::size_t>(mirrors)] = normal;
    if (mirrors + 1 < most_mirrors) mirror(next, mirrors + 1, length, search);

    const std::size_t before = search.ways.size();
    find_on_plane(search.entry, next, search.light, search.ways);
    if (search.ways.size() == before) continue;
    RefractedWay& way = search.ways.back();
    double reflected = 1.0;
    for (int i = mirrors; i >= 0; --i) {
      const Vec3& n = search.normals[static_cast<std::size_t>(i)];
      reflected *= fresnel_reflectance(std::abs(n.dot(way.start)), 1.0 / ior_);
      way.start = reflect(way.start, n);
    }
    if (!(search.rng.uniform() < reflected)) {
      search.ways.pop_back();
      continue;
    }
    way.gain /= std::exp(-search.sigma_t * length);
    way.mirrors = mirrors + 1;
    way.mirror_normals = search.normals;
  }
}

}  // namespace knotlight
