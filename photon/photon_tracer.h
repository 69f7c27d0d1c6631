// Photons from the lights into the translucent objects of a scene, one colour channel at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "photon/volume_photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct TracerOptions {
  std::size_t photons = 1'000'000;  // emitted
  std::uint64_t seed = 1;
  // first: a path ends at its first interaction, all that the source term needs.
  // all: until absorbed or out of the scene; for audits and for checking the diffusion solution.
  enum class Orders { first, all } orders = Orders::first;
  bool store = true;  // keep the volume photons (an audit alone does not need them)
};

struct TraceResult {
  std::vector<std::vector<VolumePhoton>> photons;  // per scene object; empty if not translucent
  std::vector<EnergyAudit> audit;                  // per scene object
  double emitted = 0.0;                            // power sent towards the objects, W
};

// Same bits for any number of workers. Diffuse objects absorb what hits them. Index-matched and
// refracting translucent objects are entered by Fresnel roulette; light that leaves one and enters
// another starts there at order 1 again.
TraceResult trace_photons(const Scene& scene, const RayCaster& caster, int channel,
                          const TracerOptions& options, const Workers& workers, Stage& stage);

}  // namespace knotlight
