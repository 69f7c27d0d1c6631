#include "view/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace knotlight {
namespace {

const Spectrum nothing = Spectrum::Constant(std::numeric_limits<double>::quiet_NaN());

std::string radiance_unit(const std::string& length) {
  return fmt::format("W/({}^2 sr)", length);
}
std::string length_unit(const std::string& length) {
  return length;
}
std::string no_unit(const std::string&) {
  return "";
}

Spectrum mean_intensity(const LayerPlace& place) {
  if (place.prepared.scene.objects[place.hit.object].translucent() == nullptr) return nothing;
  return place.shading.solution_at(place.hit, 1, place.rng);
}

Spectrum depth(const LayerPlace& place) {
  return Spectrum::Constant(place.hit.t);
}

Spectrum normal(const LayerPlace& place) {
  return place.hit.normal;
}

Spectrum object_number(const LayerPlace& place) {
  return Spectrum::Constant(place.hit.object);
}

}  // namespace

const std::vector<ViewLayer>& view_layers() {
  using Kind = ViewLayer::Kind;
  static const std::vector<ViewLayer> layers = {
      {"mean intensity U_d", Kind::amount, true, true, radiance_unit, mean_intensity},
      {"depth", Kind::amount, false, false, length_unit, depth},
      {"normal", Kind::direction, false, false, no_unit, normal},
      {"object", Kind::label, false, false, no_unit, object_number},
  };
  return layers;
}

Spectrum layer_value(const ViewLayer& layer, const PreparedScene& prepared, const Shading& shading,
                     const Ray& ray, Rng& rng) {
  const auto hit = prepared.caster->nearest(ray);
  if (!hit) return nothing;
  return layer.value({prepared, shading, *hit, rng});
}

}  // namespace knotlight
