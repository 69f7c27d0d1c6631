#include "photon/surroundings_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sampling.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Enough for the power of the surroundings to some per cent: it decides on a number of photons, not
// on their sum.
constexpr std::size_t trial_photons = 4096;
// Even surroundings that a trial takes for dark get this share of photons.
constexpr std::size_t fewest_share = 32;

std::vector<std::pair<std::uint32_t, const Shape*>> translucent_shapes(const Scene& scene) {
  std::vector<std::pair<std::uint32_t, const Shape*>> shapes;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].translucent() != nullptr) shapes.emplace_back(i, &scene.objects[i].shape);
  return shapes;
}

}  // namespace

SurroundingsLight::SurroundingsLight(const Scene& scene, const RayCaster& caster,
                                     const Passage& passage)
    : scene_(scene),
      caster_(caster),
      passage_(passage),
      surfaces_(surroundings_reflect(scene) ? SurfaceSampler(translucent_shapes(scene))
                                            : SurfaceSampler({})),
      any_(surfaces_.area() > 0.0 && !scene.lights.empty()) {}

SurroundingsLight::Photon SurroundingsLight::sample(const std::array<double, 4>& u,
                                                    Rng& rng) const {
  const SurfaceSampler::Point x = surfaces_(u[0], u[1]);
  const Vec3 out = Frame(x.surface.normal).to_world(sample_cosine_hemisphere(u[2], u[3]));
  LightRay back{x.surface.position, out};
  back.on_surface = true;
  back.object = x.object;
  const auto hit = passage_.next_outside(back);
  if (!hit || passage_.item(hit->object).translucent) return {};
  Photon photon;
  photon.power = pi * surfaces_.area() * reflected_radiance(scene_, caster_, *hit, out, rng);
  photon.start = {hit->position, -out};
  photon.start.on_surface = true;
  photon.start.object = hit->object;
  return photon;
}

std::size_t SurroundingsLight::photons_beside(const Emitter& emitter, int channel,
                                              std::size_t photons) const {
  if (!any_) return 0;
  double power = 0.0;
  for (std::size_t i = 0; i < trial_photons; ++i) {
    Rng rng(0, Stream::surroundings, i);
    std::array<double, 4> u{};
    for (double& number : u) number = rng.uniform();
    power += sample(u, rng).power[channel] / static_cast<double>(trial_photons);
  }
  const double share = std::min(1.0, power / emitter.power());  // 1 if the lights send nothing
  const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(photons)));
  return std::max(wanted, photons / fewest_share + 1);
}

}  // namespace knotlight
