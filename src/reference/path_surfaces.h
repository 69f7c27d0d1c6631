// Which surface a path of light meets next, in a scene whose objects may touch or stand in each
// other. Written apart from photon/passage.h, which answers the same question for photons: what one
// of the two gets wrong must not be hidden by the other.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "reference/refracted_ways.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Where a path is, where it goes, and in which medium.
struct PathRay {
  Vec3 position = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();  // away from the eye, unit
  bool inside = false;             // of the translucent `medium`; else in free space
  std::uint32_t medium = 0;
  std::optional<std::uint32_t> surface;  // the object whose surface `position` lies on
};

class PathSurfaces {
 public:
  // `scene` and `caster` must outlive this; caster was built from scene.objects in order.
  PathSurfaces(const Scene& scene, const RayCaster& caster);

  // The next surface within `distance`, nothing if there is none. From outside it is the front of a
  // translucent object or any side of a diffuse one; from inside, the medium's own surface or a
  // diffuse object before it. The hit's t is the distance from ray.position, its normal outward.
  std::optional<Hit> next(const PathRay& ray,
                          double distance = std::numeric_limits<double>::infinity()) const;

  // Whether light can go that way from `start`, which is in the medium that it was refracted into,
  // up to the crossing: off its mirrors and past nothing else.
  bool open(const PathRay& start, const RefractedWay& way) const;

  // Whether p is where light in that medium can be; false if rounding let a path slip out.
  bool plausible(const Vec3& p, std::uint32_t medium) const;
  // The translucent object that p lies in.
  std::optional<std::uint32_t> medium_around(const Vec3& p) const;
  // Surfaces nearer to each other than this are taken as touching.
  double touching_distance() const { return touch_; }

 private:
  struct Body {
    bool translucent;
    const Sphere* sphere;  // null for a mesh
    Bounds bounds;
    bool secluded;  // no other object comes near its bounds
    std::vector<std::uint32_t> neighbours;
  };

  std::optional<Hit> next_outside(const PathRay& ray, double distance) const;
  std::optional<Hit> next_inside(const PathRay& ray, double distance) const;
  std::optional<Hit> own_surface(const PathRay& ray, double distance) const;
  std::optional<Hit> touched(const Vec3& p, const Vec3& d, std::uint32_t object) const;

  const RayCaster& caster_;
  std::vector<Body> bodies_;
  double touch_;
  bool alone_and_convex_;  // light that leaves the only object meets nothing any more
};

}  // namespace knotlight
