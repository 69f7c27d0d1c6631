// Photons from the lights into the translucent objects of a scene, one colour channel at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "photon/energy_audit.h"
#include "photon/flux_tally.h"
#include "photon/volume_photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct TracerOptions {
  std::size_t photons = 1'000'000;  // emitted by the lights
  std::uint64_t seed = 1;
  // first: a path ends at its first interaction, all that the source of a single convex object
  // needs. reentering: one path in four goes on, with four times the power, so that light that
  // leaves an object and meets it, or another one, again is counted too; first interactions alone
  // are stored, also of light that the objects emit themselves, once it has left them. returned:
  // every path goes on, and of what reentering would store only light that was scattered before it
  // entered again: the part that expected values (expected_values.h) leave out. all: until absorbed
  // or out of the scene; for audits and for checking the diffusion solution.
  enum class Orders { first, reentering, returned, all } orders = Orders::first;
  bool store = true;  // keep the volume photons (an audit alone does not need them)
};

struct TraceResult {
  std::vector<std::vector<VolumePhoton>> photons;  // per scene object; empty if not translucent
  std::vector<EnergyAudit> audit;                  // per scene object
  double emitted = 0.0;  // W, sent by the lights towards the sphere around the translucent objects
};

// Same bits for any number of workers; photon i draws the same numbers in every channel, so that
// the noise of the channels is alike and colours do not speckle. Beside the photons of the lights,
// as many as SurroundingsLight has it come from the diffuse objects. Light that leaves one
// translucent object and enters another starts there at order 1 again. With Orders::first the
// audit's `absorbed` is 0: all that interacts is `unfollowed`; with Orders::reentering `unfollowed`
// may be negative, since some paths go on with more power. The bar of `stage` counts the photons of
// the lights. `fluxes` (of translucent objects of this scene) receive the light of all photons
// followed; with Orders::all they are the solution of the transfer equation.
TraceResult trace_photons(const Scene& scene, const RayCaster& caster, int channel,
                          const TracerOptions& options, const Workers& workers, Stage& stage,
                          std::span<FluxTally> fluxes = {});

}  // namespace knotlight
