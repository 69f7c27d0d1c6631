// What the tracer leaves behind and the map stores.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace knotlight {

// A photon at the moment it interacts (is scattered or absorbed) inside a translucent object.
struct VolumePhoton {
  Vec3 position;
  Vec3 direction;       // of travel before the interaction, unit
  double power;         // dPhi, W
  std::uint32_t order;  // 1 = first interaction since it entered the object
};

// Where the power that arrived at one object from outside went, W. Standard errors come from the
// spread over batches of photons. incident = reflected + absorbed + escaped + lost in each batch,
// up to the roulette's noise; docs/theory.md, "Energy audit".
struct EnergyAudit {
  double incident = 0.0;   // arrived at the surface from outside
  double reflected = 0.0;  // thrown back at arrival (Fresnel)
  double absorbed = 0.0;
  double escaped = 0.0;              // left through the surface after having entered
  double lost = 0.0;                 // photons dropped because of rounding at edges; must be tiny
  double entered_unscattered = 0.0;  // escaped without any interaction (part of `escaped`)
  double standard_error_absorbed = 0.0;
  double standard_error_escaped = 0.0;
  double standard_error_reflected = 0.0;
  std::size_t photons = 0;  // that arrived
};

}  // namespace knotlight
