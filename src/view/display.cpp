#include "view/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/false_colour.h"

namespace knotlight {
namespace {

constexpr double scale_quantile = 0.995;  // a few bright pixels may be off the scale
// A scale begins at 0 unless the least value is more than this share of the largest: depths would
// else be told apart by a few colours only.
constexpr double far_from_zero = 0.3;
const Spectrum background = Spectrum::Constant(0.12);  // of layers, where they have no value

// Display values of exposed ones up to 4, beyond which they are white within half a level of 255.
class ToneTable {
 public:
  ToneTable() {
    for (std::size_t i = 0; i < bytes_.size(); ++i)
      bytes_[i] = static_cast<std::uint8_t>(
          std::lround(255.0 * display_value((static_cast<double>(i) + 0.5) / steps_per_unit)));
  }
  std::uint8_t operator()(double exposed) const {
    const double step = exposed * steps_per_unit;
    if (!(step > 0.0)) return bytes_[0];
    return step < size ? bytes_[static_cast<std::size_t>(step)] : bytes_.back();
  }

 private:
  static constexpr double steps_per_unit = 8192.0;  // half a level of 255 in the darkest tones
  static constexpr int size = 4 * 8192;
  std::array<std::uint8_t, size> bytes_{};
};

template <class PerChannel>
ScreenImage bytes_of(const Image& image, PerChannel byte) {
  ScreenImage screen{image.width, image.height, {}};
  screen.pixels.reserve(image.pixels.size());
  for (const Spectrum& pixel : image.pixels)
    screen.pixels.push_back(0xff000000U | static_cast<std::uint32_t>(byte(pixel[0])) << 16U |
                            static_cast<std::uint32_t>(byte(pixel[1])) << 8U | byte(pixel[2]));
  return screen;
}

// Colours that differ from their neighbours in the list [OI08].
Spectrum label_colour(double label) {
  static const std::array<Spectrum, 8> colours = {
      Spectrum(0.90, 0.62, 0.00), Spectrum(0.34, 0.71, 0.91), Spectrum(0.00, 0.62, 0.45),
      Spectrum(0.94, 0.89, 0.26), Spectrum(0.00, 0.45, 0.70), Spectrum(0.84, 0.37, 0.00),
      Spectrum(0.80, 0.47, 0.65), Spectrum(0.60, 0.60, 0.60)};
  return colours[static_cast<std::size_t>(label) % colours.size()];
}

}  // namespace

ScreenImage tone_mapped_bytes(const Image& linear, double exposure) {
  static const ToneTable tone;
  return bytes_of(linear, [&](double x) { return tone(x * exposure); });
}

Image display_image(const Image& linear, double exposure) {
  Image display = linear;
  for (Spectrum& pixel : display.pixels) pixel = (pixel * exposure).unaryExpr(&display_value);
  return display;
}

LayerScale layer_scale(const Image& values, int channel) {
  ValueMap map{values.width, values.height, {}};
  double least = std::numeric_limits<double>::infinity();
  for (const Spectrum& value : values.pixels) {
    map.values.push_back(value[channel]);
    if (value[channel] < least) least = value[channel];
  }
  const double high = quantile_of_size(map, scale_quantile);
  if (!(high > 0.0)) return {0.0, 1.0};
  const bool is_near = !(least > far_from_zero * high) || least >= high;
  return {is_near ? 0.0 : least, high};
}

Image layer_colours(const Image& values, const ViewLayer& layer, int channel,
                    const LayerScale& scale) {
  Image display = values;
  for (Spectrum& pixel : display.pixels) {
    if (pixel.isNaN().any()) {
      pixel = background;
      continue;
    }
    switch (layer.kind) {
      case ViewLayer::Kind::amount:
        pixel = map_colour(ColourMap::sequential,
                           (pixel[channel] - scale.low) / (scale.high - scale.low));
        break;
      case ViewLayer::Kind::direction:
        pixel = 0.5 + 0.5 * pixel;
        break;
      case ViewLayer::Kind::label:
        pixel = label_colour(pixel[0]);
        break;
    }
  }
  return display;
}

ScreenImage display_bytes(const Image& display) {
  return bytes_of(display, [](double x) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(x, 0.0, 1.0)));
  });
}

std::string describe_value(const ViewLayer& layer, const Spectrum& value, int channel,
                           const Scene& scene) {
  if (value.isNaN().any()) return "";
  switch (layer.kind) {
    case ViewLayer::Kind::amount:
      return fmt::format("{:.4g} {}", value[channel], layer.unit(scene.units));
    case ViewLayer::Kind::direction:
      return fmt::format("({:.3f}, {:.3f}, {:.3f})", value[0], value[1], value[2]);
    case ViewLayer::Kind::label:
      return scene.objects[static_cast<std::size_t>(value[0])].name;
  }
  return "";
}

}  // namespace knotlight
