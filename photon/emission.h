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

// Chooses a light with probability proportional to the power it sends into the target sphere and a
// ray of it that may meet the sphere. Unbiased: the expected sum of power/n over rays that meet any
// subset of the sphere is the power the lights send into it (through empty space).
class Emitter {
 public:
  // Target: the sphere around `target`. scene_bounds: for the start of rays from infinity.
  Emitter(const std::vector<Light>& lights, int channel, const Bounds& target,
          const Bounds& scene_bounds);

  // False if no light sends anything.
  bool any() const { return total_ > 0.0; }
  EmittedPhoton sample(Rng& rng) const;

 private:
  struct Source {
    const Light* light;
    double power;  // estimate used for the choice
  };
  std::vector<Source> sources_;
  double total_ = 0.0;
  int channel_;
  Vec3 center_;
  double radius_;
  double distance_;  // at which rays from infinity start
};

}  // namespace knotlight
