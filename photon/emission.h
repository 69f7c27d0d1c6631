// Photons as they leave the lights, aimed at the sphere around all translucent objects.
#pragma once

#include <vector>

#include "core/rng.h"
#include "scene/scene.h"

namespace knotlight {

struct EmittedPhoton {
  Vec3 origin;
  Vec3 direction;  // unit
  double power;    // W carried if it were the only photon; divide by the number emitted
};

// Chooses a light with probability proportional to an estimate of the power it sends into the
// target sphere, and a ray of it that may meet the sphere. Unbiased: the expected sum of power/n
// over rays that meet any subset of the sphere is the power the lights send into it (through empty
// space). All photons of point, directional and constant environment lights carry equal power; an
// area light's vary with the cosine at the light where the target looks small from it, a map's with
// the colour and the interpolation.
class Emitter {
 public:
  // Target: the sphere around `target`. scene_bounds: of all that can be in the way (contains
  // `target`); rays from infinity and from lights outside start at the sphere around it.
  // `lights` must outlive the emitter.
  Emitter(const std::vector<Light>& lights, int channel, const Bounds& target,
          const Bounds& scene_bounds);

  // False if no light sends anything.
  bool any() const { return total_ > 0.0; }
  EmittedPhoton sample(Rng& rng) const;

 private:
  struct Source {
    const Light* light;
    double power;  // W, estimate used for the choice
  };
  // The sphere that photons are aimed at, as seen from a point.
  struct Cone {
    Vec3 axis;                   // unit; to the sphere's centre
    double cosine_max_deficit;   // 1 - cos(half angle); 2 from inside the sphere: all directions
    double solid_angle() const;  // sr
  };

  Cone cone_from(const Vec3& p) const;
  Vec3 start(const Vec3& origin, const Vec3& direction) const;
  Vec3 start_of_parallel_ray(const Vec3& direction, Rng& rng) const;

  double power_estimate(const PointLight& light) const;
  double power_estimate(const DirectionalLight& light) const;
  double power_estimate(const AreaLight& light) const;
  double power_estimate(const EnvironmentLight& light) const;
  // A ray with its power before the choice among lights is accounted for.
  EmittedPhoton sample_light(const PointLight& light, Rng& rng) const;
  EmittedPhoton sample_light(const DirectionalLight& light, Rng& rng) const;
  EmittedPhoton sample_light(const AreaLight& light, Rng& rng) const;
  EmittedPhoton sample_light(const EnvironmentLight& light, Rng& rng) const;

  std::vector<Source> sources_;
  double total_ = 0.0;  // W, sum of the estimates
  int channel_;
  Vec3 center_;  // of the target sphere
  double radius_;
  Vec3 scene_center_;
  double scene_radius_;
};

}  // namespace knotlight
