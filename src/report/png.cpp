// Portable Network Graphics, ISO/IEC 15948: a signature and chunks, each with its length, name,
// data and check sum; the pixels are one zlib stream of lines, each behind the number of the filter
// that was applied to it.
#include "report/png.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace knotlight {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr int compression_level = 9;  // pages are written once and read often

void append_u32(Bytes& bytes, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0})
    bytes.push_back(static_cast<unsigned char>(value >> shift & 0xFFU));
}

void append_chunk(Bytes& bytes, const std::string& name, const Bytes& data) {
  append_u32(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = bytes.size();
  bytes.insert(bytes.end(), name.begin(), name.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  // Over name and data.
  append_u32(bytes, static_cast<std::uint32_t>(
                        crc32(0, bytes.data() + start, static_cast<uInt>(bytes.size() - start))));
}

// Every line as differences to the pixel on its left (filter 1): smooth pictures become runs of
// small numbers, which compress well.
Bytes filtered_lines(const Image& display) {
  constexpr unsigned char filter_sub = 1;
  Bytes lines;
  lines.reserve(static_cast<std::size_t>(display.height) * (3 * display.width + 1));
  for (int y = 0; y < display.height; ++y) {
    lines.push_back(filter_sub);
    unsigned char left[3] = {0, 0, 0};
    for (int x = 0; x < display.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double value = display.at(x, y)[c];
        if (!std::isfinite(value))
          throw std::runtime_error("the picture has pixels that are not finite");
        const auto byte =
            static_cast<unsigned char>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
        lines.push_back(static_cast<unsigned char>(byte - left[c]));
        left[c] = byte;
      }
  }
  return lines;
}

}  // namespace

std::vector<unsigned char> png_bytes(const Image& display) {
  if (display.width < 1 || display.height < 1)
    throw std::runtime_error("a picture without pixels cannot be written");
  const Bytes lines = filtered_lines(display);
  uLongf size = compressBound(static_cast<uLong>(lines.size()));
  Bytes packed(size);
  if (compress2(packed.data(), &size, lines.data(), static_cast<uLong>(lines.size()),
                compression_level) != Z_OK)
    throw std::runtime_error("a picture cannot be compressed");
  packed.resize(size);

  Bytes header;
  append_u32(header, static_cast<std::uint32_t>(display.width));
  append_u32(header, static_cast<std::uint32_t>(display.height));
  // 8 bits, true colour; the only compression, filtering and order that there are.
  header.insert(header.end(), {8, 2, 0, 0, 0});

  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk(png, "IHDR", header);
  append_chunk(png, "sRGB", {0});  // perceptual intent
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace knotlight
