// The life of one photon: surface by surface and interaction by interaction.
#pragma once

#include <vector>

#include "core/rng.h"
#include "photon/emission.h"
#include "photon/energy_audit.h"
#include "photon/flux_tally.h"
#include "photon/passage.h"
#include "photon/volume_photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// What a walk leaves behind, per scene object.
struct WalkRecord {
  std::vector<std::vector<VolumePhoton>> photons;
  std::vector<PowerTally> tally;
  std::vector<FluxSums> fluxes;  // any number, of any objects; none costs nothing
};

// The scene in one channel as a photon sees it, and the rules it walks by:
// - a translucent object is entered and left by roulette with the Fresnel reflectance, through a
//   rough surface facet by facet; the power is conserved (radiance is what refraction compresses),
// - inside, the free flight has density sigma_t exp(-sigma_t s) [V09 6.18]; at an interaction the
//   albedo decides whether the photon goes on, the phase function where to,
// - a diffuse object, also one inside a translucent one, reflects by roulette with its reflectance
//   in a direction of density cosine/pi per solid angle, else absorbs. Where light meets it
//   straight from a light, through nothing but index-matched media, the walk ends: what becomes of
//   that light is SurroundingsLight's.
class PhotonWalk {
 public:
  struct Options {
    // With which a path goes on after its first interaction ever, its power divided by it.
    double follow_probability = 0.0;
    bool store = true;
    bool store_first_only = false;  // of each stay in an object
    // Not the first interaction ever of a path: what is stored is light that was scattered, left an
    // object and came back.
    bool store_returned_only = false;
  };

  // `scene` and `caster` must outlive the walk; caster was built from scene.objects in order.
  PhotonWalk(const Scene& scene, const RayCaster& caster, int channel, const Options& options);

  const Passage& passage() const { return passage_; }

  // Follows a photon (power is what it carries) to its end and adds to the record, whose lists have
  // one entry per scene object.
  void run(const EmittedPhoton& start, Rng& rng, WalkRecord& record) const;
  // The same from a surface, or from where Passage::start would put it. Power in W.
  void run(const LightRay& start, double power, Rng& rng, WalkRecord& record) const;
  // The same for light that translucent `object` emits itself: until it leaves it is as light that
  // was scattered there already.
  void run_emitted(const EmittedPhoton& start, std::uint32_t object, Rng& rng,
                   WalkRecord& record) const;

 private:
  struct Flight;

  void follow(Flight& flight, Rng& rng, WalkRecord& record) const;
  void meet_diffuse(Flight& flight, const Hit& hit, Rng& rng, PowerTally& tally) const;
  void walk_outside(Flight& flight, Rng& rng, WalkRecord& record) const;
  void walk_inside(Flight& flight, Rng& rng, WalkRecord& record) const;
  void interact(Flight& flight, Rng& rng, WalkRecord& record) const;

  Passage passage_;
  Options options_;
};

}  // namespace knotlight
