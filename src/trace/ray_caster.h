// Rays against the scene: the one file that knows Embree. Embree finds which primitive a ray meets
// in float; the meeting point is then recomputed in double on the true triangle or sphere, so that
// points handed on lie on their surface to rounding.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/shape.h"
#include "core/vec3.h"

namespace knotlight {

struct Ray {
  Vec3 origin;
  Vec3 direction;  // unit
  double t_max = std::numeric_limits<double>::infinity();
};

struct Hit {
  double t = 0.0;               // distance along the ray
  std::uint32_t object = 0;     // index into the list given to RayCaster
  std::uint32_t primitive = 0;  // triangle of a mesh; 0 for a sphere
  double b1 = 0.0, b2 = 0.0;    // barycentric coordinates of corners 1 and 2; 0 for a sphere
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // outward unit normal of the true shape
};

// Where on an object's surface a point is nearest to it.
struct NearestPoint {
  SurfacePoint surface;
  std::uint32_t primitive = 0;  // triangle of a mesh; 0 for a sphere
  double distance = 0.0;
};

class RayCaster {
 public:
  // Keeps copies of what it needs of the shapes.
  explicit RayCaster(const std::vector<const Shape*>& shapes);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // The nearest surface met at a distance in (skip_distance(), t_max): a ray that starts on a
  // surface does not meet it again.
  std::optional<Hit> nearest(const Ray& ray) const;
  // The same against one object alone.
  std::optional<Hit> nearest(const Ray& ray, std::uint32_t object) const;
  // Whether anything lies between a and b (both may lie on surfaces).
  bool occluded(const Vec3& a, const Vec3& b) const;
  bool occluded(const Ray& ray) const;

  // Whether p is inside closed object `object` (winding number > 0).
  bool inside(const Vec3& p, std::uint32_t object) const;
  // The point of the object's surface nearest to p.
  SurfacePoint nearest_surface_point(const Vec3& p, std::uint32_t object) const {
    return nearest_point(p, object)->surface;
  }
  // The same with what it lies on; nothing if the surface is further away than max_distance.
  std::optional<NearestPoint> nearest_point(
      const Vec3& p, std::uint32_t object,
      double max_distance = std::numeric_limits<double>::infinity()) const;
  // Length of the part of the ray (up to t_max) that lies inside the object, whatever it crosses.
  double path_length_inside(const Ray& ray, std::uint32_t object) const;
  // Distances at which the ray crosses the object's surface, increasing, with +1 for leaving and -1
  // for entering; crossings are merged so that overlapping parts count as one inside.
  struct Crossing {
    double t;
    bool leaving;
  };
  std::vector<Crossing> crossings(const Ray& ray, std::uint32_t object) const;

  // 1e-7 of the radius of the sphere around all shapes.
  double skip_distance() const;
  // Surfaces nearer than this to each other count as touching for those who follow light, and a ray
  // from inside a medium starts this far behind its photon: well above the rounding of the search
  // in float, far below any modelled gap.
  double touching_distance() const { return 50.0 * skip_distance(); }

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace knotlight
