// Light that translucent objects emit themselves, photon by photon. The solver has it as a source
// of diffuse light in the object itself; what gets out and enters that object again, or another
// one, takes photons.
#pragma once

#include <vector>

#include "core/rng.h"
#include "photon/emission.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

class VolumeEmission {
 public:
  // Both must outlive this; caster was built from scene.objects in order.
  VolumeEmission(const Scene& scene, const RayCaster& caster, int channel);

  double power() const { return bodies_.empty() ? 0.0 : bodies_.back().power_up_to; }  // W

  struct Photon {
    EmittedPhoton photon;  // carries power() if it is the only one
    std::uint32_t object;  // that it starts in
  };
  // Objects by their power, places with density 1/volume per volume, directions 1/(4 pi) per solid
  // angle. power() > 0.
  Photon sample(Rng& rng) const;

 private:
  struct Body {
    double power_up_to;  // of all bodies up to this one
    std::uint32_t object;
    Bounds bounds;
  };
  const RayCaster& caster_;
  std::vector<Body> bodies_;
};

}  // namespace knotlight
