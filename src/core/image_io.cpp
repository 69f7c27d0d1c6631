#include "core/image_io.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "core/errors.h"
#include "core/file_io.h"

namespace knotlight {
namespace {

constexpr double exposure_quantile =
    0.99;                                // a few highlights may clip, the body of the picture not
constexpr double exposure_target = 0.8;  // display value of that quantile before the sRGB curve
constexpr double shoulder_start = 0.7;   // values below are untouched by the shoulder

// Rec. 709 luminance.
double luminance(const Spectrum& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

// Linear up to shoulder_start, then an exponential approach to 1 with continuous slope.
double shoulder(double x) {
  if (x <= shoulder_start) return std::max(0.0, x);
  const double room = 1.0 - shoulder_start;
  return 1.0 - room * std::exp(-(x - shoulder_start) / room);
}

// IEC 61966-2-1.
double srgb_encode(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

template <typename T>
void write_pixels(const std::string& temporary, const std::string& path, const Image& image,
                  const Metadata& metadata, OIIO::TypeDesc type, const std::vector<T>& data) {
  OIIO::ImageSpec spec(image.width, image.height, 3, type);
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  // OpenImageIO would put the clock in; the same scene and seed must give the same file.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  if (type == OIIO::TypeDesc::FLOAT) {
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
  } else {
    spec.attribute("oiio:ColorSpace", "sRGB");
  }
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(temporary);
  const bool written =
      out && out->open(temporary, spec) && out->write_image(type, data.data()) && out->close();
  if (!written)
    throw std::runtime_error(fmt::format("{}: cannot write the picture: {}", path,
                                         out ? out->geterror() : OIIO::geterror()));
}

}  // namespace

void check_image_extension(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".exr" && extension != ".png")
    throw InputError(
        fmt::format("{}: cannot write format '{}', expected .exr or .png", path, extension));
}

Image read_image(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("{}: no such file, expected a picture", path));
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

Image tone_map(const Image& linear) {
  std::vector<double> lit;
  for (const Spectrum& c : linear.pixels)
    if (luminance(c) > 0.0) lit.push_back(luminance(c));
  double exposure = 1.0;
  if (!lit.empty()) {
    const auto rank =
        static_cast<std::ptrdiff_t>(exposure_quantile * static_cast<double>(lit.size() - 1));
    std::nth_element(lit.begin(), lit.begin() + rank, lit.end());
    exposure = exposure_target / lit[static_cast<std::size_t>(rank)];
  }
  Image display = linear;
  for (Spectrum& c : display.pixels)
    c = (c * exposure).unaryExpr([](double x) { return srgb_encode(shoulder(x)); });
  return display;
}

void write_image(const std::string& path, const Image& image, const Metadata& metadata) {
  check_image_extension(path);
  for (const Spectrum& c : image.pixels)
    if (!c.isFinite().all())
      throw std::runtime_error(path + ": the picture has pixels that are not finite");
  const bool png = std::filesystem::path(path).extension() == ".png";
  write_atomically(path, [&](const std::string& temporary) {
    if (png) {
      std::vector<unsigned char> data;
      for (const Spectrum& c : tone_map(image).pixels)
        for (const double x : c) data.push_back(static_cast<unsigned char>(std::lround(255.0 * x)));
      write_pixels(temporary, path, image, metadata, OIIO::TypeDesc::UINT8, data);
    } else {
      std::vector<float> data;
      for (const Spectrum& c : image.pixels)
        for (const double x : c) data.push_back(static_cast<float>(x));
      write_pixels(temporary, path, image, metadata, OIIO::TypeDesc::FLOAT, data);
    }
  });
}

}  // namespace knotlight
