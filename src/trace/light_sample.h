// A light as a point anywhere in space sees it, before anything shadows it.
#pragma once

#include <optional>

#include "core/rng.h"
#include "scene/scene.h"

namespace knotlight {

struct LightSample {
  Vec3 to_light = Vec3::UnitZ();           // unit
  double distance = 0.0;                   // infinite for lights at infinity
  Spectrum irradiance = Spectrum::Zero();  // W/length^2 on a plane that faces the light
};

// One unbiased sample of a light's irradiance at `position`: exact for point and directional
// lights, a random point of an area light (density 1/area per area), a random direction of an
// environment map (in proportion to what it sends). Nothing from the back of an area light, and
// nothing for a constant environment, which is as well met by going in any direction.
std::optional<LightSample> sample_light(const Light& light, const Vec3& position, Rng& rng);

}  // namespace knotlight
