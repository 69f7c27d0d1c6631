// Pictures as PNG bytes in memory, for embedding in a page. Files are written by core/image_io.h.
#pragma once

#include <vector>

#include "core/image_io.h"

namespace knotlight {

// 8 bits per colour, sRGB. `display` holds display values 0..1 (tone_map gives them); values
// outside are clipped. Throws std::runtime_error for a picture without pixels or with values that
// are not finite.
std::vector<unsigned char> png_bytes(const Image& display);

}  // namespace knotlight
