// Pictures in and out (OpenImageIO, in image_module/). Images are written whole or not at all.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/vec3.h"

namespace knotlight {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<Spectrum> pixels;  // row by row from the top, linear

  Spectrum& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Spectrum& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

using Metadata = std::vector<std::pair<std::string, std::string>>;

// Reads any format OpenImageIO knows, as linear colour; throws InputError (without file:line
// prefix) if it can't, or if a pixel is negative or not finite.
Image read_image(const std::string& path);

// By extension: .exr linear 32-bit float with metadata; .png 8 bit, tone-mapped (see tone_map),
// metadata as text. Throws InputError for another extension, std::runtime_error if writing fails.
void write_image(const std::string& path, const Image& image, const Metadata& metadata);

// One float plane of a picture with many, e.g. "R" or "variance.R": width * height values, row by
// row from the top.
struct Layer {
  std::string channel;
  std::vector<float> values;
};

struct LayeredImage {
  int width = 0;
  int height = 0;
  std::vector<Layer> layers;

  // The plane of that channel; throws InputError naming those there are.
  const std::vector<float>& values(const std::string& channel) const;
};

// One .exr with a channel per layer, 32-bit float, losslessly compressed. Any program shows those
// named R, G, B; read_image reads these three. Infinite values are kept (a depth may have them).
// Throws InputError for another extension, std::runtime_error for not-a-number or if writing fails.
void write_layers(const std::string& path, int width, int height, const std::vector<Layer>& layers,
                  const Metadata& metadata);
// All channels of a picture, values as they are in the file. Throws InputError if it can't.
LayeredImage read_layers(const std::string& path);

// The check of the extension alone, for before the work starts. Throws InputError.
void check_image_extension(const std::string& path);

// Display values 0..1 (sRGB encoded): exposure so that the 99th percentile of luminance maps to
// 0.8, a soft shoulder above that, then the sRGB curve [IEC 61966-2-1].
Image tone_map(const Image& linear);
// Its two steps: the factor that the picture's values are multiplied by (1 for a black one), and
// the display value of what comes out.
double automatic_exposure(const Image& linear);
double display_value(double exposed);

}  // namespace knotlight
