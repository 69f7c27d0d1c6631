#include "photon/volume_emission.h"

#include <algorithm>
#include <cassert>

#include "core/sampling.h"

namespace knotlight {

VolumeEmission::VolumeEmission(const Scene& scene, const RayCaster& caster, int channel)
    : caster_(caster) {
  double power = 0.0;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const TranslucentMaterial* material = scene.objects[i].translucent();
    if (material == nullptr || material->emission[channel] == 0.0) continue;
    const Shape& shape = scene.objects[i].shape;
    bodies_.push_back({power += material->emission[channel] * volume(shape), i, bounds(shape)});
  }
}

VolumeEmission::Photon VolumeEmission::sample(Rng& rng) const {
  assert(power() > 0.0);
  const double chosen = rng.uniform() * power();
  const auto body =
      std::upper_bound(bodies_.begin(), bodies_.end() - 1, chosen,
                       [](double value, const Body& b) { return value < b.power_up_to; });
  Vec3 position;
  do {
    for (int axis = 0; axis < 3; ++axis)
      position[axis] =
          body->bounds.lo[axis] + rng.uniform() * (body->bounds.hi[axis] - body->bounds.lo[axis]);
  } while (!caster_.inside(position, body->object));
  const double u = rng.uniform();
  const double v = rng.uniform();
  return {{position, sample_sphere(u, v), power()}, body->object};
}

}  // namespace knotlight
