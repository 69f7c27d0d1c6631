// What the viewer can show in place of the picture: one row of a table per layer.
#pragma once

#include <string>
#include <vector>

#include "pipeline/scene_setup.h"
#include "render/shading.h"

namespace knotlight {

// What a layer is computed from.
struct LayerPlace {
  const PreparedScene& prepared;
  const Shading& shading;
  const Hit& hit;  // the first surface the ray meets
  Rng& rng;
};

struct ViewLayer {
  enum class Kind {
    amount,     // a value per channel, shown by the sequential colour map
    direction,  // a unit vector, its components shown as red, green and blue
    label,      // a whole number, shown by a colour of its own
  };
  const char* name;
  Kind kind;
  bool per_channel;  // of the light; else its three values belong together or are one
  bool by_chance;    // one sample per pixel is an estimate with noise
  std::string (*unit)(const std::string& length);  // given the name of the scene's unit of length
  // Three values; not-a-number where the layer has none.
  Spectrum (*value)(const LayerPlace& place);
};

const std::vector<ViewLayer>& view_layers();

// The layer along a ray; not-a-number where the ray meets nothing.
Spectrum layer_value(const ViewLayer& layer, const PreparedScene& prepared, const Shading& shading,
                     const Ray& ray, Rng& rng);

}  // namespace knotlight
