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
// The check of the extension alone, for before the work starts. Throws InputError.
void check_image_extension(const std::string& path);

// Display values 0..1 (sRGB encoded): exposure so that the 99th percentile of luminance maps to
// 0.8, a soft shoulder above that, then the sRGB curve [IEC 61966-2-1].
Image tone_map(const Image& linear);

}  // namespace knotlight
