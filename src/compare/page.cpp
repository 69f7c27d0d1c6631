#include "compare/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "compare/pictures.h"
#include "compare/slice.h"
#include "compare/verdict.h"
#include "report/chart.h"
#include "report/html.h"
#include "report/png.h"

namespace knotlight {
namespace {

const char* in_plain_words(SourceModel model) {
  switch (model) {
    case SourceModel::photon_map:
      return "follows rays from the lights through the surface and puts the light that is "
             "scattered "
             "for the first time where that happens, in depth, with its direction. It knows "
             "shadows "
             "inside the object, slanted light and lamps within.";
    case SourceModel::irradiance_sampling:
      return "measures how brightly each place of the surface is lit and puts all that light as "
             "one "
             "point at one transport mean free path below it. The energy is right, the depth is "
             "right on average, the direction of the light is forgotten.";
    case SourceModel::irradiance_thesis:
      return "does the same as the thesis of 2009 did: the light becomes a value at a knot, not an "
             "amount of power, so what it adds up to depends on how many knots there are. Kept to "
             "show what that costs. It needs the thesis's solver, whose errors come on top.";
    case SourceModel::boundary_flux:
      return "takes light as fully diffuse the moment it enters: no source inside the object at "
             "all, only light flowing in through the surface. The simplest model; it misses the "
             "layer in which light turns diffuse.";
  }
  return "";
}

std::string seconds(double value) {
  return fmt::format("{:.2f}", value);
}

std::string figures_table(const Comparison& c) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& name, const ModelRun& run, const ModelErrors& e) {
    if (!run.ran()) {
      rows.push_back({name, "not run", "", "", "", "", "", "", "", "", ""});
      return;
    }
    rows.push_back(
        {name, percent(e.surface), percent(e.picture), percent(e.diffusion), percent(e.transport),
         percent(e.noise), percent(e.numerical), seconds(run.cost.light),
         seconds(run.cost.grid + run.cost.solve), seconds(run.cost.picture),
         std::isfinite(run.cost.memory) ? fmt::format("{:.0f}", run.cost.memory) : "unknown"});
  };
  for (const ComparedModel& model : c.models)
    add(name_of(model.run.model), model.run, model.errors);
  add("converged diffusion", c.converged, c.diffusion_itself);
  return html_table(
      {"model", "error: surface", "picture", "inside", "inside, against photons",
       "noise, own estimate", "solver, own estimate", "s: light", "s: solve", "s: picture", "MiB"},
      rows);
}

std::string models_section(const Comparison& c) {
  std::string html = html_heading(2, "The models");
  for (const ComparedModel& model : c.models) {
    html += html_heading(3, name_of(model.run.model));
    html += html_paragraph(fmt::format("It {}", in_plain_words(model.run.model)));
    if (!model.run.ran())
      html += html_paragraph("Not run on this scene: " + model.run.cannot);
    else if (!model.run.solved->report.failures.empty())
      html += html_paragraph("Its own checks say: " + model.run.solved->report.failures.front() +
                             (model.run.solved->report.failures.size() > 1 ? " (and more)." : "."));
  }
  return html;
}

std::string pictures_section(const Comparison& c) {
  std::string html = html_heading(2, "The pictures");
  html += html_paragraph(
      "All with the same exposure. The first is the converged diffusion solution: the photon map "
      "with more photons and smaller cells, what every model would give if its source were right "
      "and its errors gone.");
  html += html_row(picture_figures(c));
  html += html_paragraph(
      "Where they differ: luminance minus that of the converged picture, in parts of its root mean "
      "square. Blue is too dark, red too bright, white is right. Fine grain is noise of the "
      "picture's own samples (boundary_flux draws other ones than the rest); broad patches are the "
      "model.");
  html += difference_figures(c, &ComparedModel::picture, "picture");
  return html;
}

std::string surface_section(const Comparison& c) {
  std::string html = html_heading(2, "The field on the surface");
  html += html_paragraph(
      "U_d, the mean intensity of scattered light at the surface, as the camera sees it and "
      "without reflections: first the converged solution, then what each model adds to it or takes "
      "away, in parts of its root mean square. Channel 0.");
  html += surface_figure(c);
  html += difference_figures(c, &ComparedModel::surface, "surface");
  return html;
}

// A model that is wildly off would flatten all other lines of a chart.
constexpr double most_above = 2.5;  // times the largest converged value
// From this range of values on, in one line, a linear scale hides the small ones.
constexpr double wide_range = 30.0;

Chart line_chart(const Comparison& c, std::size_t line) {
  const Eigen::VectorXd& converged = c.converged_lines[line];
  const double largest = most_above * converged.maxCoeff();
  const bool wide = converged.maxCoeff() > wide_range * converged.minCoeff();
  Chart chart{"U_d " + c.lines[line].name,
              "depth, transport mean free paths",
              fmt::format("U_d, W/({}² sr)", c.units),
              false,
              wide,
              {}};
  std::vector<double> depths;
  ChartSeries truth{"photons of all orders", {}, {}, {}, false, true};
  for (const LineCell& place : c.line_cells[line]) {
    const auto cell = static_cast<Eigen::Index>(place.cell);
    depths.push_back(place.depth * c.sigma_tr);
    truth.y.push_back(c.truth.U_d[cell]);
    truth.error.push_back(c.truth.U_d_error[cell]);
  }
  truth.x = depths;
  const auto add = [&](const std::string& name, const Eigen::VectorXd& values, bool dashed) {
    ChartSeries series{name, depths, {}, {}, true, false, dashed};
    for (const double value : values)
      series.y.push_back(
          value >= 0.0 && value <= largest ? value : std::numeric_limits<double>::quiet_NaN());
    chart.series.push_back(std::move(series));
  };
  for (const ComparedModel& model : c.models)
    if (model.run.ran()) add(name_of(model.run.model), model.lines[line], false);
  add("converged", converged, true);
  if (c.no_truth.empty()) chart.series.push_back(std::move(truth));
  return chart;
}

std::string lines_section(const Comparison& c) {
  std::string html = html_heading(2, "Into the object");
  html += html_paragraph(fmt::format(
      "Three lines straight into '{}', with U_d of every model. {} The distance between the "
      "converged line and the photons is what diffusion itself gets wrong; that between a model "
      "and "
      "the converged line is the model's source, its noise and its solver.",
      c.object,
      c.no_truth.empty()
          ? fmt::format(
                "The points are photons of all orders ({:.1f} million), counted in cells of {:.2f} "
                "transport mean free paths with bars of one standard error: the truth, "
                "without any diffusion equation.",
                1e-6 * static_cast<double>(c.truth.photons), c.truth.cell * c.sigma_tr)
          : "There are no photons to compare with: " + c.no_truth + "."));
  for (std::size_t l = 0; l < c.lines.size(); ++l) {
    if (c.line_cells[l].empty()) {
      html += html_paragraph(
          fmt::format("The line {} is too short to hold a whole cell.", c.lines[l].name));
      continue;
    }
    const Vec3& at = c.lines[l].start;
    html += html_figure_svg(
        chart_svg(line_chart(c, l)), fmt::format("line{}", l),
        fmt::format(
            "Line {}, starting at ({:.3g}, {:.3g}, {:.3g}), where {:.3g} W/{}² enter. Values "
            "below zero or above {} times the largest converged one are left out.",
            c.lines[l].name, at.x(), at.y(), at.z(), c.lines[l].entered, c.units, most_above));
  }
  return html;
}

std::string slices_section(const Comparison& c) {
  std::string html = html_heading(2, "What the models put into the object");
  html += html_paragraph(
      "The source of diffuse light on a slice through the brightest place, seen from the camera's "
      "side: the photon map's layer, bright where light enters and fading with depth, against the "
      "other models' idea of it. Grey is outside.");
  html += slice_figures(c);
  return html;
}

std::string budgets_section(const Comparison& c) {
  Chart chart{"Error on the surface against seconds, channel 0",
              "seconds for light and solve",
              "rms difference to the converged solution",
              true,
              true,
              {}};
  bool anything = false;
  for (const ComparedModel& model : c.models) {
    ChartSeries series{name_of(model.run.model), {}, {}, {}, true, true};
    for (const BudgetPoint& point : model.budgets) {
      series.x.push_back(point.seconds);
      series.y.push_back(point.error);
      anything = anything || (point.error > 0.0 && std::isfinite(point.error));
    }
    chart.series.push_back(std::move(series));
  }
  std::string html = html_heading(2, "Error against time");
  if (!anything) return html + html_paragraph("No model came to a solution.");
  html += html_figure_svg(
      chart_svg(chart), "budgets",
      "From left to right each model is given more to go by: photons (1/64 to all of the "
      "comparison's), samples of irradiance (500 to 108 000) or knots (60 to 480). A line that "
      "falls is still losing noise; one that has become level shows what the model itself gets "
      "wrong, which no patience mends. A photon map below the others' level is worth its time.");
  return html;
}

std::string method_section(const Comparison& c) {
  std::string html = html_heading(2, "How this was made");
  html += html_paragraph(fmt::format(
      "Every error is a root mean square, relative to that of what it is measured against. "
      "Surface, inside and lines: U_d in channel 0; picture: luminance where the camera sees a "
      "translucent object. \"Surface\", \"picture\" and \"inside\" measure against the converged "
      "solution, which by its own estimate is good to {} and has photons of its own, so that noise "
      "is not mistaken for agreement. \"Inside, against photons\" takes all {} cells that lie "
      "wholly in '{}'; the photons' own noise has been taken off.",
      percent(c.converged_error), c.truth.centers.cols(), c.object));
  html += html_paragraph(fmt::format(
      "photon_map used {} rays per channel here; seconds are for all channels, memory is the peak "
      "beyond what the scene takes. The photons of all orders took {:.1f} s. boundary_flux solves "
      "for U_ri + U_d; U_ri is taken off before anything is compared.",
      c.photons, c.truth.seconds));
  html += html_paragraph(
      "Beside this page: compare.csv (a row per model), lines.csv (the fields along the lines), "
      "budgets.csv (error against time).");
  return html;
}

}  // namespace

std::string compare_page(const Comparison& c) {
  const std::string name = std::filesystem::path(c.scene_path).filename().string();
  std::string body;
  std::vector<std::string> sentences = verdict(c);
  body += html_callout(sentences.back());
  sentences.pop_back();
  body += html_list(sentences);
  body += figures_table(c);
  body += pictures_section(c) + surface_section(c) + lines_section(c) + slices_section(c) +
          budgets_section(c) + models_section(c) + method_section(c);
  return html_page("Source models compared: " + name,
                   "The same scene, lit by the same lights, with four ideas of how light from "
                   "outside becomes diffuse light inside.",
                   body);
}

}  // namespace knotlight
