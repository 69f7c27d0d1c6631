// From what was rendered to bytes on the screen.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/layers.h"
#include "view/picture_thread.h"

namespace knotlight {

// 0xffRRGGBB, row by row from the top.
struct ScreenImage {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
};

// Linear radiance times `exposure` with the tone curve of .png files (core/image_io.h, tone_map).
ScreenImage tone_mapped_bytes(const Image& linear, double exposure);
// The same as display values 0..1, for a file.
Image display_image(const Image& linear, double exposure);

// What the colours of a layer of kind amount mean.
struct LayerScale {
  double low = 0.0, high = 1.0;
};
// From 0 (or the least value, if that is far from 0) to a value that hardly any pixel exceeds, of
// one channel.
LayerScale layer_scale(const Image& values, int channel);
// Values of a layer as display colours; amounts are those of one channel.
Image layer_colours(const Image& values, const ViewLayer& layer, int channel,
                    const LayerScale& scale);
ScreenImage display_bytes(const Image& display);

// A pixel of a layer in words: "0.123 W/(mm^2 sr)", "(0.00, 0.60, 0.80)", "knot"; empty where the
// layer has no value.
std::string describe_value(const ViewLayer& layer, const Spectrum& value, int channel,
                           const Scene& scene);

}  // namespace knotlight
