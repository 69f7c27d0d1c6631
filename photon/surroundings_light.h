// Light on its last way from a diffuse object to a translucent one, sampled from where it arrives:
// a table can be large and the object on it small, and no ray is wasted on the rest of the table.
#pragma once

#include <array>
#include <optional>

#include "core/rng.h"
#include "photon/emission.h"
#include "photon/passage.h"
#include "photon/surface_sampler.h"

namespace knotlight {

// What the diffuse objects throw on the translucent ones of the light that has met nothing but
// lights, diffuse objects and, straight through, index-matched media. Light that a translucent
// object has scattered, refracted or mirrored is followed forwards from there, and reflected by
// diffuse objects as it meets them (first_light_tracer.h, photon_walk.h): each path counts once.
class SurroundingsLight {
 public:
  // All must outlive this; `passage` is of the same scene.
  SurroundingsLight(const Scene& scene, const RayCaster& caster, const Passage& passage);

  // False if no diffuse object reflects, or there is no translucent object or no light.
  bool any() const { return any_; }

  struct Photon {
    LightRay start;                     // on the diffuse object
    Spectrum power = Spectrum::Zero();  // W it would carry as the only photon; often zero
  };
  // u: place on the translucent surfaces (0, 1: density 1/area per area) and direction (2, 3:
  // density cosine/pi per solid angle). L, the radiance from what lies there, takes numbers of
  // `rng`; the power is pi area L. Unbiased: the mean power of photons that arrive in any region is
  // what arrives there.
  Photon sample(const std::array<double, 4>& u, Rng& rng) const;

  // How many photons go with `photons` of the lights' own in `channel` so that they carry about as
  // much power each, between a thirty-second and all of them; none without reflecting surroundings.
  std::size_t photons_beside(const Emitter& emitter, int channel, std::size_t photons) const;

 private:
  const Scene& scene_;
  const RayCaster& caster_;
  const Passage& passage_;
  SurfaceSampler surfaces_;
  bool any_;
};

}  // namespace knotlight
