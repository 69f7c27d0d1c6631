#include "scene/shines.h"

#include <algorithm>

namespace knotlight {
namespace {

bool shines(const Light& light) {
  const Spectrum& power = std::visit(
      [](const auto& l) -> const Spectrum& {
        using L = std::decay_t<decltype(l)>;
        if constexpr (std::is_same_v<L, PointLight>) {
          return l.intensity;
        } else if constexpr (std::is_same_v<L, DirectionalLight>) {
          return l.irradiance;
        } else {
          return l.radiance;
        }
      },
      light);
  return (power > 0.0).any();
}

bool shines(const Object& object) {
  const TranslucentMaterial* material = object.translucent();
  return material != nullptr && (material->emission > 0.0).any();
}

}  // namespace

bool anything_shines(const Scene& scene) {
  const auto lit = [](const auto& thing) { return shines(thing); };
  return std::any_of(scene.lights.begin(), scene.lights.end(), lit) ||
         std::any_of(scene.objects.begin(), scene.objects.end(), lit);
}

}  // namespace knotlight
