#include "core/image_io.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/errors.h"
#include "core/file_io.h"
#include "core/image_module/image_codec.h"

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

// The module lies beside the program, or, for test programs, up to two folders above it.
std::string module_path() {
  std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (int level = 0; level < 3; ++level, folder = folder.parent_path())
    if (std::filesystem::exists(folder / image_codec_library))
      return (folder / image_codec_library).string();
  throw std::runtime_error(fmt::format("{} is not beside the program", image_codec_library));
}

// Loads the module once.
const ImageCodec& codec() {
  static const ImageCodec& loaded = [&]() -> const ImageCodec& {
    void* library = dlopen(module_path().c_str(), RTLD_NOW);
    void* symbol = library != nullptr ? dlsym(library, image_codec_symbol) : nullptr;
    if (symbol == nullptr)
      throw std::runtime_error(fmt::format("cannot load the picture module: {}", dlerror()));
    return *reinterpret_cast<ImageCodecEntry*>(symbol)();
  }();
  return loaded;
}

template <typename T>
PixelBlock<T> pixel_block(const Image& image, T (*convert)(double)) {
  PixelBlock<T> block{image.width, image.height, {}};
  block.values.reserve(3 * image.pixels.size());
  for (const Spectrum& c : image.pixels)
    for (const double x : c) block.values.push_back(convert(x));
  return block;
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
  return codec().read(path);
}

LayeredImage read_layers(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("{}: no such file, expected a picture", path));
  return codec().read_layers(path);
}

const std::vector<float>& LayeredImage::values(const std::string& channel) const {
  std::vector<std::string> names;
  for (const Layer& layer : layers) {
    if (layer.channel == channel) return layer.values;
    names.push_back(layer.channel);
  }
  throw InputError(
      fmt::format("there is no channel '{}', expected one of {}", channel, fmt::join(names, ", ")));
}

double automatic_exposure(const Image& linear) {
  std::vector<double> lit;
  for (const Spectrum& c : linear.pixels)
    if (luminance(c) > 0.0) lit.push_back(luminance(c));
  if (lit.empty()) return 1.0;
  const auto rank =
      static_cast<std::ptrdiff_t>(exposure_quantile * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), lit.begin() + rank, lit.end());
  return exposure_target / lit[static_cast<std::size_t>(rank)];
}

double display_value(double exposed) {
  return srgb_encode(shoulder(exposed));
}

Image tone_map(const Image& linear) {
  const double exposure = automatic_exposure(linear);
  Image display = linear;
  for (Spectrum& c : display.pixels) c = (c * exposure).unaryExpr(&display_value);
  return display;
}

void write_image(const std::string& path, const Image& image, const Metadata& metadata) {
  check_image_extension(path);
  for (const Spectrum& c : image.pixels)
    if (!c.isFinite().all())
      throw std::runtime_error(path + ": the picture has pixels that are not finite");
  const bool png = std::filesystem::path(path).extension() == ".png";
  write_atomically(path, [&](const std::string& temporary) {
    if (png)
      codec().write_bytes(
          temporary,
          pixel_block<unsigned char>(
              tone_map(image),
              [](double x) { return static_cast<unsigned char>(std::lround(255.0 * x)); }),
          metadata);
    else
      codec().write_float(temporary,
                          pixel_block<float>(image, [](double x) { return static_cast<float>(x); }),
                          metadata);
  });
}

void write_layers(const std::string& path, int width, int height, const std::vector<Layer>& layers,
                  const Metadata& metadata) {
  if (std::filesystem::path(path).extension() != ".exr")
    throw InputError(fmt::format("{}: only .exr holds layers, expected a name with it", path));
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  PixelBlock<float> block{width, height, std::vector<float>(pixels * layers.size())};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    assert(layers[i].values.size() == pixels);
    names.push_back(layers[i].channel);
    for (std::size_t k = 0; k < pixels; ++k) {
      const float value = layers[i].values[k];
      if (std::isnan(value))
        throw std::runtime_error(
            fmt::format("{}: layer {} has pixels that are not a number", path, names.back()));
      block.values[k * layers.size() + i] = value;
    }
  }
  write_atomically(path, [&](const std::string& temporary) {
    codec().write_layers(temporary, block, names, metadata);
  });
}

}  // namespace knotlight
