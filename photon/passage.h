// How light gets from surface to surface through a scene: which surface comes next, when objects
// touch, contain or shield each other. Every kind of light tracing asks this; none decides it
// alone.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Light under way: where it is and which medium it is in.
struct LightRay {
  Vec3 position;
  Vec3 direction;  // of travel, unit
  bool inside = false;
  bool on_surface = false;   // of `object`; else in free space or in its interior
  std::uint32_t object = 0;  // that it is inside of, or on the surface of

  Ray ray(double t_max = std::numeric_limits<double>::infinity()) const {
    return {position, direction, t_max};
  }
};

// The scene in one channel. Surfaces of two objects that touch are met in the order they must be:
// own surface, then the other's.
class Passage {
 public:
  struct Item {  // a scene object
    bool translucent;
    double sigma_t, albedo, g, ior;
    Bounds bounds;
    std::vector<std::uint32_t> touching;         // objects that may touch it
    std::vector<std::uint32_t> touching_opaque;  // the diffuse ones among them
  };

  // `caster` must outlive this; it was built from scene.objects in order.
  Passage(const Scene& scene, const RayCaster& caster, int channel);

  const Item& item(std::uint32_t object) const { return items_[object]; }
  // A sphere around the translucent objects; nothing if there are none.
  const std::optional<Sphere>& target() const { return target_; }
  const Bounds& scene_bounds() const { return scene_bounds_; }

  // Light as it leaves its source: inside the translucent object that the source lies in, if any.
  LightRay start(const Vec3& position, const Vec3& direction) const;
  // The next surface in free space; nothing if the light leaves the scene.
  std::optional<Hit> next_outside(const LightRay& light) const;
  // What ends a flight of at most `distance` inside light.object: its own surface or, before that,
  // an opaque one; nothing if the flight ends in the medium. `t` of the hit is not to be used.
  std::optional<Hit> next_inside(const LightRay& light, double distance) const;
  // False where rounding has carried light that was inside the object out of its bounding box.
  bool within_bounds(const Vec3& p, std::uint32_t object) const;

 private:
  std::optional<std::uint32_t> object_around(const Vec3& p) const;
  std::optional<Hit> contact(const Vec3& p, const Vec3& d, std::uint32_t object) const;

  const RayCaster& caster_;
  std::vector<Item> items_;
  std::optional<Sphere> target_;
  Bounds scene_bounds_;
  double touch_;  // length: surfaces closer than this may touch
};

}  // namespace knotlight
