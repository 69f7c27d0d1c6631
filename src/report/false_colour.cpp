#include "report/false_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "report/html.h"

namespace knotlight {
namespace {

using Stops = std::array<std::array<double, 3>, 9>;

// Every 32nd entry of the published table of 256 colours [vdW15].
constexpr Stops viridis = {{{0.267, 0.005, 0.329},
                            {0.279, 0.175, 0.483},
                            {0.230, 0.322, 0.546},
                            {0.173, 0.449, 0.558},
                            {0.128, 0.567, 0.551},
                            {0.158, 0.684, 0.502},
                            {0.369, 0.789, 0.383},
                            {0.678, 0.864, 0.190},
                            {0.993, 0.906, 0.144}}};
// ColorBrewer's RdBu turned round [HB03], with a white middle.
constexpr Stops blue_to_red = {{{0.020, 0.188, 0.380},
                                {0.176, 0.445, 0.698},
                                {0.455, 0.678, 0.820},
                                {0.796, 0.886, 0.937},
                                {1.000, 1.000, 1.000},
                                {0.988, 0.843, 0.769},
                                {0.937, 0.569, 0.447},
                                {0.745, 0.180, 0.196},
                                {0.404, 0.000, 0.122}}};
constexpr double nothing = 0.88;  // grey of places without a value: unlike any colour of the maps

}  // namespace

Spectrum map_colour(ColourMap map, double t) {
  if (std::isnan(t)) return Spectrum::Constant(nothing);
  const Stops& stops = map == ColourMap::sequential ? viridis : blue_to_red;
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double share = place - static_cast<double>(stop);
  Spectrum colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[static_cast<Eigen::Index>(c)] =
        (1.0 - share) * stops[stop][c] + share * stops[stop + 1][c];
  return colour;
}

Image false_colour(const ValueMap& map, const ColourScale& scale) {
  Image image{map.width, map.height, {}};
  image.pixels.reserve(map.values.size());
  for (const double value : map.values)
    image.pixels.push_back(map_colour(scale.map, (value - scale.low) / (scale.high - scale.low)));
  return image;
}

std::string colour_bar_svg(const ColourScale& scale, const std::string& label) {
  constexpr int steps = 64;
  std::string svg =
      "<svg viewBox=\"0 0 330 52\" style=\"max-width:22rem\" xmlns=\"http://www.w3.org/2000/svg\" "
      "font-family=\"sans-serif\" "
      "font-size=\"11\">";
  for (int i = 0; i < steps; ++i) {
    const Spectrum c = 255.0 * map_colour(scale.map, (i + 0.5) / steps);
    // A little wider than the step, so that no seams show.
    svg += fmt::format(
        "<rect x=\"{:.2f}\" y=\"17\" width=\"{}\" height=\"14\" "
        "fill=\"rgb({:.0f},{:.0f},{:.0f})\"/>",
        15.0 + i * 300.0 / steps, i + 1 < steps ? 5.2 : 4.69, c[0], c[1], c[2]);
  }
  svg += fmt::format("<text x=\"15\" y=\"11\">{}</text>", html_escape(label));
  const double middle = 0.5 * (scale.low + scale.high);
  for (const auto& [x, anchor, value] :
       {std::tuple{15, "start", scale.low}, std::tuple{165, "middle", middle},
        std::tuple{315, "end", scale.high}})
    svg +=
        fmt::format("<text x=\"{}\" y=\"45\" text-anchor=\"{}\">{:.3g}</text>", x, anchor, value);
  return svg + "</svg>";
}

double quantile_of_size(const ValueMap& map, double quantile) {
  std::vector<double> sizes;
  for (const double value : map.values)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 0.0;
  const auto rank = std::lround(quantile * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), sizes.begin() + rank, sizes.end());
  return sizes[static_cast<std::size_t>(rank)];
}

}  // namespace knotlight
