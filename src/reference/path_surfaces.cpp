#include "reference/path_surfaces.h"

#include <algorithm>
#include <cmath>

#include "core/convexity.h"
#include "core/fresnel.h"

namespace knotlight {
namespace {

// Normals this near to each other are those of one mirror: far above rounding, far below the angles
// between the planes of a shape that has few.
constexpr double same_mirror = 1e-6;

bool contains(const Bounds& box, const Vec3& p, double slack) {
  return (p.array() >= box.lo.array() - slack).all() && (p.array() <= box.hi.array() + slack).all();
}

bool meet(const Bounds& a, const Bounds& b, double slack) {
  return (a.lo.array() <= b.hi.array() + slack).all() &&
         (b.lo.array() <= a.hi.array() + slack).all();
}

// The way out of a sphere from a point inside it or, up to rounding, on it; nothing if rounding has
// put the point so far outside that the line misses the sphere.
std::optional<Hit> way_out(const Sphere& sphere, std::uint32_t object, const Vec3& p,
                           const Vec3& d) {
  const Vec3 from_center = p - sphere.center;
  const double along = from_center.dot(d);
  const double half_chord2 =
      sphere.radius * sphere.radius - (from_center - along * d).squaredNorm();
  if (half_chord2 < 0.0) return std::nullopt;
  Hit hit;
  hit.object = object;
  hit.t = std::max(0.0, std::sqrt(half_chord2) - along);
  hit.normal = (from_center + hit.t * d).normalized();
  hit.position = sphere.center + sphere.radius * hit.normal;
  return hit;
}

}  // namespace

PathSurfaces::PathSurfaces(const Scene& scene, const RayCaster& caster)
    : caster_(caster), touch_(caster.touching_distance()) {
  for (const Object& object : scene.objects)
    bodies_.push_back({object.translucent() != nullptr,
                       std::get_if<Sphere>(&object.shape),
                       bounds(object.shape),
                       true,
                       {}});
  for (std::uint32_t i = 0; i < bodies_.size(); ++i)
    for (std::uint32_t j = 0; j < bodies_.size(); ++j)
      if (i != j && meet(bodies_[i].bounds, bodies_[j].bounds, touch_))
        bodies_[i].neighbours.push_back(j);
  for (Body& body : bodies_) body.secluded = body.neighbours.empty();
  alone_and_convex_ = scene.objects.size() == 1 && bodies_.front().translucent &&
                      is_convex(scene.objects.front().shape);
}

std::optional<Hit> PathSurfaces::next(const PathRay& ray, double distance) const {
  return ray.inside ? next_inside(ray, distance) : next_outside(ray, distance);
}

// Where the line through p along d meets `object` so near to p, on either side, that a ray from p
// would pass over it.
std::optional<Hit> PathSurfaces::touched(const Vec3& p, const Vec3& d, std::uint32_t object) const {
  return caster_.nearest({p - touch_ * d, d, 2.0 * touch_}, object);
}

std::optional<Hit> PathSurfaces::next_outside(const PathRay& ray, double distance) const {
  if (ray.surface && alone_and_convex_) return std::nullopt;
  if (ray.surface) {
    // What touches the surface that the ray starts on: a diffuse object shields it; a translucent
    // one is entered, if the ray goes into it.
    for (const std::uint32_t other : bodies_[*ray.surface].neighbours) {
      if (bodies_[other].translucent) continue;
      if (auto hit = touched(ray.position, ray.direction, other)) {
        hit->t = 0.0;
        return hit;
      }
    }
    for (const std::uint32_t other : bodies_[*ray.surface].neighbours) {
      if (!bodies_[other].translucent) continue;
      auto hit = touched(ray.position, ray.direction, other);
      if (hit && hit->normal.dot(ray.direction) < 0.0) {
        hit->t = 0.0;
        return hit;
      }
    }
  }
  auto hit = caster_.nearest({ray.position, ray.direction, distance});
  if (!hit || !bodies_[hit->object].translucent) return hit;
  for (const std::uint32_t other : bodies_[hit->object].neighbours) {
    if (bodies_[other].translucent) continue;
    if (auto shield = touched(hit->position, ray.direction, other)) {
      shield->t = hit->t;
      return shield;
    }
  }
  return hit;
}

std::optional<Hit> PathSurfaces::own_surface(const PathRay& ray, double distance) const {
  const Body& body = bodies_[ray.medium];
  if (body.sphere != nullptr) {
    auto hit = way_out(*body.sphere, ray.medium, ray.position, ray.direction);
    return hit && hit->t < distance ? hit : std::nullopt;
  }
  const bool on_it = ray.surface && *ray.surface == ray.medium;
  std::optional<Hit> hit;
  if (!on_it) {
    // A search from the interior starts a little behind, or it would pass over a surface just
    // ahead; what it then finds behind the point does not count.
    hit = caster_.nearest({ray.position - touch_ * ray.direction, ray.direction, distance + touch_},
                          ray.medium);
    if (hit) hit->t -= touch_;
  }
  if (on_it || (hit && hit->t <= 0.0))
    hit = caster_.nearest({ray.position, ray.direction, distance}, ray.medium);
  return hit;
}

std::optional<Hit> PathSurfaces::next_inside(const PathRay& ray, double distance) const {
  std::optional<Hit> own = own_surface(ray, distance);
  if (bodies_[ray.medium].secluded) return own;
  // A diffuse object in the medium ends the way, if it comes clearly before the medium's end: one
  // that lies against the surface from outside is met by whoever has left.
  std::optional<Hit> first = own;
  for (const std::uint32_t other : bodies_[ray.medium].neighbours) {
    if (bodies_[other].translucent) continue;
    const double limit = first ? first->t - (first->object == ray.medium ? touch_ : 0.0) : distance;
    if (limit <= 0.0) continue;
    if (auto hit = caster_.nearest({ray.position, ray.direction, limit}, other)) first = hit;
  }
  return first;
}

bool PathSurfaces::open(const PathRay& start, const RefractedWay& way) const {
  PathRay ray = start;
  ray.direction = way.start;
  double left = way.length;
  for (int i = 0;; ++i) {
    const auto hit = next(ray, left + touch_);
    if (!hit || hit->object != ray.medium) return false;
    left -= hit->t;
    if (i == way.mirrors) return left <= touch_;
    const Vec3& normal = way.mirror_normals[static_cast<std::size_t>(i)];
    if ((hit->normal - normal).norm() > same_mirror) return false;
    ray.position = hit->position;
    ray.surface = ray.medium;
    ray.direction = reflect(ray.direction, normal);
  }
}

bool PathSurfaces::plausible(const Vec3& p, std::uint32_t medium) const {
  return contains(bodies_[medium].bounds, p, touch_);
}

std::optional<std::uint32_t> PathSurfaces::medium_around(const Vec3& p) const {
  for (std::uint32_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].translucent && contains(bodies_[i].bounds, p, 0.0) && caster_.inside(p, i))
      return i;
  return std::nullopt;
}

}  // namespace knotlight
