#include "compare/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/slice.h"
#include "compare/verdict.h"
#include "report/html.h"
#include "report/png.h"

namespace knotlight {
namespace {

// Scales of maps: a few outliers may take the end colours.
constexpr double scale_quantile = 0.98;
// Differences smaller than the first are white on every page, or else noise would look like a
// finding; ones above the second take the end colours, or one bad model would bleach all others.
constexpr double least_scale = 0.02, largest_scale = 0.3;
constexpr double decades = 3.0;  // shown of a source density: below is a thousandth of the most

std::string bar(const ColourScale& scale, const std::string& label, const std::string& name) {
  return html_figure_svg(colour_bar_svg(scale, label), name, "");
}

// Tone-mapped together, so that one exposure serves all.
std::vector<Image> tone_map_together(const std::vector<const Image*>& images) {
  Image all{images.front()->width, 0, {}};
  for (const Image* image : images) {
    all.height += image->height;
    all.pixels.insert(all.pixels.end(), image->pixels.begin(), image->pixels.end());
  }
  const Image display = tone_map(all);
  std::vector<Image> result;
  auto next = display.pixels.begin();
  for (const Image* image : images) {
    const auto end = next + static_cast<std::ptrdiff_t>(image->pixels.size());
    result.push_back({image->width, image->height, {next, end}});
    next = end;
  }
  return result;
}

}  // namespace

std::vector<std::string> picture_figures(const Comparison& c) {
  std::vector<const Image*> images = {&*c.converged.picture};
  std::vector<std::string> captions = {"converged diffusion"};
  for (const ComparedModel& model : c.models) {
    if (!model.run.ran()) continue;
    images.push_back(&*model.run.picture);
    captions.push_back(
        fmt::format("{}: {} off", name_of(model.run.model), percent(model.errors.picture)));
  }
  const std::vector<Image> display = tone_map_together(images);
  std::vector<std::string> figures;
  for (std::size_t i = 0; i < display.size(); ++i)
    figures.push_back(
        html_figure_png(png_bytes(display[i]), "picture by " + captions[i], captions[i]));
  return figures;
}

std::string surface_figure(const Comparison& c) {
  const ColourScale scale{ColourMap::sequential, 0.0,
                          quantile_of_size(c.converged_surface, scale_quantile)};
  if (!(scale.high > 0.0)) return html_paragraph("No light reaches the surface that is seen.");
  const std::string figure =
      html_figure_png(png_bytes(false_colour(c.converged_surface, scale)),
                      "U_d on the surface in false colour", "converged diffusion: U_d");
  return html_row({figure, bar(scale, fmt::format("U_d, W/({}² sr)", c.units), "surface-bar")});
}

std::string difference_figures(const Comparison& c, ValueMap ComparedModel::*map,
                               const std::string& name) {
  double largest = least_scale;
  for (const ComparedModel& model : c.models)
    if (model.run.ran()) largest = std::max(largest, quantile_of_size(model.*map, scale_quantile));
  const double end = std::min(largest, largest_scale);
  const ColourScale scale{ColourMap::diverging, -end, end};
  std::vector<std::string> figures;
  for (const ComparedModel& model : c.models) {
    if (!model.run.ran()) continue;
    const std::string title = name_of(model.run.model);
    figures.push_back(html_figure_png(png_bytes(false_colour(model.*map, scale)),
                                      "difference map of " + title, title));
  }
  return html_row(figures) + bar(scale, "difference, parts of the rms", name + "-difference-bar");
}

std::string slice_figures(const Comparison& c) {
  // Of the first model, the photon map, where it ran: sheets of points are far denser.
  double largest = 0.0;
  for (const ComparedModel& model : c.models)
    if (model.run.ran() && !(largest > 0.0))
      largest = quantile_of_size(model.slice, scale_quantile);
  if (!(largest > 0.0)) return html_paragraph("No light enters the slice.");
  const ColourScale scale{ColourMap::sequential, -decades, 0.0};
  std::vector<std::string> figures;
  for (const ComparedModel& model : c.models) {
    if (!model.run.ran()) continue;
    const std::string title = name_of(model.run.model);
    std::string caption = title;
    if (model.run.model == SourceModel::boundary_flux)
      caption +=
          ": no volume source of light from outside; what is seen, if anything, is light that "
          "left the object and came back";
    if (model.run.model == SourceModel::irradiance_thesis)
      caption +=
          ": values at knots one transport mean free path deep, which have no density to "
          "draw; what is seen, if anything, is light that left the object and came back";
    if (model.run.model == SourceModel::irradiance_sampling)
      caption += ": a sheet of points one transport mean free path under the surface";
    figures.push_back(html_figure_png(
        png_bytes(false_colour(decades_below(model.slice, largest, -decades), scale)),
        "source density of " + title, caption));
  }
  return html_row(figures) +
         bar(scale, fmt::format("powers of ten below {:.3g} W/({}⁴ sr)", largest, c.units),
             "slice-bar");
}

}  // namespace knotlight
