// Photons as they leave the lights, aimed at the sphere around all translucent objects.
#pragma once

#include <array>
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
  // target: around all that is to be lit. scene_bounds: of all that can be in the way (contains
  // what is to be lit); rays from infinity and from lights outside start at the sphere around it.
  // `lights` must outlive the emitter.
  Emitter(const std::vector<Light>& lights, int channel, const Sphere& target,
          const Bounds& scene_bounds);

  // False if no light sends anything.
  bool any() const { return total_ > 0.0; }
  double power() const { return total_; }  // W, as estimated
  EmittedPhoton sample(Rng& rng) const;

  // The same light by light, for those who choose the numbers themselves. Lights that send nothing
  // do not count.
  std::size_t lights() const { return sources_.size(); }
  double share(std::size_t light) const {
    return sources_[light].power / total_;
  }  // of total power
  // How many uniform numbers a ray of the light takes, 2 or 4: those of one dimension have to be
  // independent of the others only.
  int dimensions(std::size_t light) const;
  // The ray of `light` for the numbers u in [0, 1): the first two say where on the target it goes,
  // the others where on the light, or in the sky, it comes from. Its power is what it would carry
  // as the only ray of this light.
  EmittedPhoton ray(std::size_t light, const std::array<double, 4>& u) const;

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
  Vec3 start_of_parallel_ray(const Vec3& direction, double u, double v) const;

  double power_estimate(const PointLight& light) const;
  double power_estimate(const DirectionalLight& light) const;
  double power_estimate(const AreaLight& light) const;
  double power_estimate(const EnvironmentLight& light) const;
  EmittedPhoton ray_of(const PointLight& light, const std::array<double, 4>& u) const;
  EmittedPhoton ray_of(const DirectionalLight& light, const std::array<double, 4>& u) const;
  EmittedPhoton ray_of(const AreaLight& light, const std::array<double, 4>& u) const;
  EmittedPhoton ray_of(const EnvironmentLight& light, const std::array<double, 4>& u) const;

  std::vector<Source> sources_;
  double total_ = 0.0;  // W, sum of the estimates
  int channel_;
  Vec3 center_;  // of the target sphere
  double radius_;
  Vec3 scene_center_;
  double scene_radius_;
};

}  // namespace knotlight
