// The one file that knows OpenImageIO. It is a module of its own, loaded when the first picture is
// read or written: OpenImageIO brings some 250 shared libraries along, which take 0.2 s to load,
// and most calls of the program never need them.
#include "core/image_module/image_codec.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/errors.h"

namespace knotlight {
namespace {

template <typename T>
void write_pixels(const std::string& path, const PixelBlock<T>& pixels,
                  const std::vector<std::string>& names, const Metadata& metadata) {
  constexpr bool is_float = std::is_same_v<T, float>;
  const OIIO::TypeDesc type = is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(pixels.width, pixels.height, static_cast<int>(names.size()), type);
  spec.channelnames = names;
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  // OpenImageIO would put the clock in; the same scene and seed must give the same file.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  if (is_float) spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path);
  const bool written =
      out && out->open(path, spec) && out->write_image(type, pixels.values.data()) && out->close();
  if (!written)
    throw std::runtime_error(
        fmt::format("cannot write the picture: {}", out ? out->geterror() : OIIO::geterror()));
}

void write_float(const std::string& path, const PixelBlock<float>& pixels,
                 const Metadata& metadata) {
  write_pixels(path, pixels, {"R", "G", "B"}, metadata);
}

void write_bytes(const std::string& path, const PixelBlock<unsigned char>& pixels,
                 const Metadata& metadata) {
  write_pixels(path, pixels, {"R", "G", "B"}, metadata);
}

void write_channels(const std::string& path, const PixelBlock<float>& pixels,
                    const std::vector<std::string>& names, const Metadata& metadata) {
  write_pixels(path, pixels, names, metadata);
}

LayeredImage read_channels(const std::string& path) {
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in) throw InputError(fmt::format("{}: cannot read the picture: {}", path, OIIO::geterror()));
  const OIIO::ImageSpec& spec = in->spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
  std::vector<float> interleaved(pixels * channels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, interleaved.data()))
    throw InputError(fmt::format("{}: cannot read the picture: {}", path, in->geterror()));
  LayeredImage image{spec.width, spec.height, {}};
  for (std::size_t i = 0; i < channels; ++i) {
    Layer layer{spec.channelnames[i], std::vector<float>(pixels)};
    for (std::size_t k = 0; k < pixels; ++k) layer.values[k] = interleaved[k * channels + i];
    image.layers.push_back(std::move(layer));
  }
  return image;
}

Image read(const std::string& path) {
  OIIO::ImageBuf buffer(path);
  if (!buffer.read(0, 0, true, OIIO::TypeDesc::FLOAT))
    throw InputError(fmt::format("{}: cannot read the picture: {}", path, buffer.geterror()));
  Image image{buffer.spec().width, buffer.spec().height, {}};
  const int channels = buffer.nchannels();
  const bool encoded = buffer.spec().get_string_attribute("oiio:ColorSpace") == "sRGB";
  std::vector<float> pixel(static_cast<std::size_t>(channels));
  image.pixels.reserve(static_cast<std::size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      buffer.getpixel(buffer.spec().x + x, buffer.spec().y + y, pixel.data(), channels);
      Spectrum value;
      for (int c = 0; c < 3; ++c) {
        const double v = pixel[channels >= 3 ? static_cast<std::size_t>(c) : 0U];
        if (!std::isfinite(v) || v < 0.0)
          throw InputError(
              fmt::format("{}: pixel ({}, {}) is {}, expected finite values >= 0", path, x, y, v));
        value[c] = !encoded ? v : v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
      }
      image.pixels.push_back(value);
    }
  return image;
}

}  // namespace
}  // namespace knotlight

extern "C" const knotlight::ImageCodec* knotlight_image_codec() {
  static const knotlight::ImageCodec codec{knotlight::read, knotlight::write_float,
                                           knotlight::write_bytes, knotlight::write_channels,
                                           knotlight::read_channels};
  return &codec;
}
