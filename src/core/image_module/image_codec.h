// What the picture module offers: a table of functions behind one C symbol.
#pragma once

#include <string>
#include <vector>

#include "core/image_io.h"

namespace knotlight {

template <typename T>
struct PixelBlock {
  int width = 0;
  int height = 0;
  std::vector<T> values;  // 3, or one per layer, per pixel; row by row from the top
};

struct ImageCodec {
  // Linear values; throws InputError if the file cannot be read or holds values that are negative
  // or not finite.
  Image (*read)(const std::string& path);
  // Format by the path's extension; throw std::runtime_error.
  void (*write_float)(const std::string& path, const PixelBlock<float>&, const Metadata&);
  void (*write_bytes)(const std::string& path, const PixelBlock<unsigned char>&, const Metadata&);
  // Any number of named float channels, interleaved in the order of the names.
  void (*write_layers)(const std::string& path, const PixelBlock<float>&,
                       const std::vector<std::string>& names, const Metadata&);
  LayeredImage (*read_layers)(const std::string& path);
};

// The module's entry, found by name in libknotlight_images.so.
using ImageCodecEntry = const ImageCodec*();
constexpr const char* image_codec_symbol = "knotlight_image_codec";
constexpr const char* image_codec_library = "libknotlight_images.so";

}  // namespace knotlight
