// How light gets from surface to surface through a scene: which surface comes next, when objects
// touch, contain or shield each other. Every kind of light tracing asks this; none decides it
// alone.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/rng.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Light under way: where it is and which medium it is in.
struct LightRay {
  Vec3 position;
  Vec3 direction;  // of travel, unit
  bool inside = false;
  // On that of `object`, or of an opaque one inside it; else in free space or in its interior.
  bool on_surface = false;
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
    double sigma_t, albedo, g, ior, alpha;
    Bounds bounds;
    std::vector<std::uint32_t> touching;         // objects that may touch it
    std::vector<std::uint32_t> touching_opaque;  // the diffuse ones among them
  };

  // `scene` and `caster` must outlive this; caster was built from scene.objects in order.
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
  // Reflected part of what arrives where light met a diffuse object.
  double reflectance(const Hit& hit) const;
  // False where rounding has carried light that was inside the object out of its bounding box.
  bool within_bounds(const Vec3& p, std::uint32_t object) const;

 private:
  std::optional<std::uint32_t> object_around(const Vec3& p) const;
  std::optional<Hit> contact(const Vec3& p, const Vec3& d, std::uint32_t object) const;

  const Scene& scene_;
  const RayCaster& caster_;
  int channel_;
  std::vector<Item> items_;
  std::optional<Sphere> target_;
  Bounds scene_bounds_;
  double touch_;  // length: surfaces closer than this may touch
};

// Light at the surface of a translucent object, which throws it back or lets it through by dice.
// eta = index beyond over index before the surface; `alpha` 0: smooth. Takes one number of rng if
// smooth.
struct Crossing {
  Vec3 direction;  // of travel afterwards, unit
  bool through;
};
Crossing cross_surface(const Vec3& direction, const Vec3& normal, double eta, double alpha,
                       Rng& rng);

// Light that a diffuse surface has reflected, on the side that it came from: density cosine/pi per
// solid angle. u, v in [0, 1).
LightRay reflected_diffusely(const LightRay& arriving, const Hit& hit, double u, double v);

}  // namespace knotlight
