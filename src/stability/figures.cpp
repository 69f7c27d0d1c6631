#include "stability/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/not_finite.h"
#include "report/chart.h"
#include "stability/heat_map.h"

namespace knotlight {
namespace {

using Selection = std::function<bool(const Trial&)>;
using Number = std::function<double(const Trial&)>;

double error_of(const Trial& t) {
  return t.outcome.error;
}
double value_of(const Trial& t) {
  return t.value;
}
double lambda_R_of(const Trial& t) {
  return t.lambda_R;
}

// Different values in the order in which they come.
template <class T, class Get>
std::vector<T> distinct(const std::vector<Trial>& trials, const Selection& wanted, const Get& get) {
  std::vector<T> found;
  for (const Trial& t : trials)
    if (wanted(t) && std::find(found.begin(), found.end(), T(get(t))) == found.end())
      found.push_back(T(get(t)));
  return found;
}

std::vector<std::string> names(const std::vector<double>& values) {
  std::vector<std::string> result;
  for (const double value : values) result.push_back(fmt::format("{:.4g}", value));
  return result;
}

// Lambda R, or what else y is, downwards; the study's own parameter across.
HeatMap map_of(const std::vector<Trial>& trials, const Selection& wanted, const std::string& title,
               const Number& y_of, const std::string& y_label, const Number& number) {
  const auto xs = distinct<double>(trials, wanted, value_of);
  const auto ys = distinct<double>(trials, wanted, y_of);
  HeatMap map{title, "", y_label, names(xs), names(ys), {}};
  map.values.assign(xs.size() * ys.size(), nan);
  for (const Trial& t : trials) {
    if (!wanted(t)) continue;
    map.x_label = t.parameter;
    const auto column = std::find(xs.begin(), xs.end(), t.value) - xs.begin();
    const auto row = std::find(ys.begin(), ys.end(), y_of(t)) - ys.begin();
    map.values[static_cast<std::size_t>(row) * xs.size() + static_cast<std::size_t>(column)] =
        number(t);
  }
  return map;
}

// One line per group in the order in which they come.
std::vector<ChartSeries> series_of(const std::vector<Trial>& trials, const Selection& wanted,
                                   const std::function<std::string(const Trial&)>& group,
                                   const Number& x, const Number& y) {
  std::vector<ChartSeries> series;
  for (const Trial& t : trials) {
    if (!wanted(t)) continue;
    auto line = std::find_if(series.begin(), series.end(),
                             [&](const ChartSeries& s) { return s.name == group(t); });
    if (line == series.end())
      line = series.insert(series.end(), {group(t), {}, {}, {}, true, true});
    line->x.push_back(x(t));
    line->y.push_back(y(t));
  }
  return series;
}

const HeatScale error_scale{1e-6, 1.0, "largest error over the largest |u|, on the surface"};

std::string noise_words(double noise) {
  return noise == 0.0 ? "no noise" : fmt::format("noise {}", noise);
}

class Figures {
 public:
  explicit Figures(const Stability& stability) : stability_(stability), all_(stability.trials) {}

  std::vector<StabilityFigure> draw() {
    for (const std::string body : {"sphere", "torus"}) {
      errors(body);
      systems(body);
    }
    for (const std::string body : {"sphere", "torus"}) distances(body);
    for (const std::string body : {"sphere", "torus"}) degrees(body);
    for (const std::string body : {"sphere", "torus"}) cuts(body);
    for (const std::string body : {"sphere", "torus"}) dense(body);
    albedos();
    widths();
    radial_functions();
    scenes();
    return std::move(figures_);
  }

 private:
  void add(const std::string& section, const std::string& name, std::string svg,
           const std::string& caption) {
    figures_.push_back({section, name, std::move(svg), caption});
  }
  void add_chart(const std::string& section, const std::string& name, const Chart& chart,
                 const std::string& caption) {
    add(section, name, chart_svg(chart), caption);
  }

  // Every method: lambda R against resolution, one row of maps per size of noise.
  void errors(const std::string& body) {
    for (const std::string field : {"far", "near"}) {
      std::vector<HeatMap> maps;
      const Selection study = [&](const Trial& t) {
        return t.study == "resolution" && t.body == body && t.field == field;
      };
      const auto methods =
          distinct<std::string>(all_, study, [](const Trial& t) { return t.method; });
      for (const double noise :
           distinct<double>(all_, study, [](const Trial& t) { return t.noise; }))
        for (const std::string& method : methods)
          maps.push_back(map_of(
              all_,
              [&](const Trial& t) { return study(t) && t.noise == noise && t.method == method; },
              fmt::format("{}, {}", method, noise_words(noise)), lambda_R_of, "lambda R",
              error_of));
      add("Error over lambda R and resolution", fmt::format("error-{}-{}", body, field),
          heat_maps_svg(maps, methods.size(), error_scale),
          fmt::format("{}, data of a source {} the surface; albedo 0.99.", body,
                      field == "far" ? "a radius above" : "one transport mean free path above"));
    }
  }

  // Rank, condition and coefficient size of the same systems.
  void systems(const std::string& body) {
    const auto one = [&](const std::string& name, const HeatScale& scale, const Number& number) {
      std::vector<HeatMap> maps;
      const Selection study = [&](const Trial& t) {
        return t.study == "resolution" && t.body == body && t.field == "far" && t.noise == 0.0 &&
               !std::isnan(number(t));
      };
      for (const std::string& method :
           distinct<std::string>(all_, study, [](const Trial& t) { return t.method; }))
        maps.push_back(map_of(
            all_, [&](const Trial& t) { return study(t) && t.method == method; }, method,
            lambda_R_of, "lambda R", number));
      add("Rank, condition and coefficients of the same systems", name + "-" + body,
          heat_maps_svg(maps, maps.size(), scale), fmt::format("{}, {}.", body, scale.label));
    };
    one("rank", {1.0, 1000.0, "rank"},
        [](const Trial& t) { return t.method == "grid" ? nan : t.outcome.rank; });
    one("condition", {1.0, 1e16, "condition"}, [](const Trial& t) { return t.outcome.condition; });
    one("coefficients",
        {1.0, 1e12,
         "largest sum of |coefficient x function| over the largest |u|, source far away"},
        [](const Trial& t) { return t.outcome.coefficient_size; });
  }

  void distances(const std::string& body) {
    const std::string section = "Exterior sources: how far outside";
    const Selection study = [&](const Trial& t) {
      return t.study == "distance" && t.body == body && t.field == "far";
    };
    const auto group = [](const Trial& t) {
      return fmt::format("lambda R {}, {}", t.lambda_R, noise_words(t.noise));
    };
    add_chart(section, "distance-" + body,
              {"mfs on the " + body + ": error", "distance in knot spacings",
               "largest error / largest |u|", true, true,
               series_of(
                   all_, [&](const Trial& t) { return study(t) && t.noise != 1e-6; }, group,
                   value_of, error_of)},
              "Source a radius above the surface.");
    add_chart(
        section, "distance-condition-" + body,
        {"mfs on the " + body + ": condition", "distance in knot spacings", "condition", true, true,
         series_of(
             all_, [&](const Trial& t) { return study(t) && t.noise == 0.0; },
             [](const Trial& t) { return fmt::format("lambda R {}", t.lambda_R); }, value_of,
             [](const Trial& t) { return t.outcome.condition; })},
        "");
  }

  void degrees(const std::string& body) {
    std::vector<HeatMap> maps;
    for (const std::string field : {"far", "near"})
      for (const double noise : {0.0, 1e-3}) {
        const Selection study = [&](const Trial& t) {
          return t.study == "degree" && t.body == body && t.field == field && t.noise == noise;
        };
        HeatMap map = map_of(
            all_, study, fmt::format("source {}, {}", field, noise_words(noise)),
            [](const Trial& t) { return std::stod(t.method); }, "patches across", error_of);
        maps.push_back(std::move(map));
      }
    add("Localized method: degree and patches", "degree-" + body,
        heat_maps_svg(maps, maps.size(), error_scale), fmt::format("{}, lambda R 3.", body));
  }

  void cuts(const std::string& body) {
    add_chart(
        "Global method: where to cut the singular values", "cut-" + body,
        {"bkm_thesis on the " + body + ": error over the cut", "relative cut",
         "largest error / largest |u|", true, true,
         series_of(
             all_,
             [&](const Trial& t) { return t.study == "cut" && t.body == body && t.field == "far"; },
             [](const Trial& t) {
               return fmt::format("lambda R {}, {}", t.lambda_R, noise_words(t.noise));
             },
             value_of, error_of)},
        "Source a radius above the surface.");
  }

  void dense(const std::string& body) {
    for (const double noise : {0.0, 1e-3})
      add_chart("Global method: dense solvers",
                fmt::format("dense-{}-{}", body, noise == 0.0 ? "exact" : "noisy"),
                {fmt::format("bkm_thesis on the {}, {}", body, noise_words(noise)), "lambda R",
                 "largest error / largest |u|", true, true,
                 series_of(
                     all_,
                     [&](const Trial& t) {
                       return t.study == "dense" && t.body == body && t.field == "far" &&
                              t.noise == noise;
                     },
                     [](const Trial& t) { return t.method; }, value_of, error_of)},
                "Source a radius above the surface.");
  }

  void albedos() {
    for (const std::string field : {"far", "near"})
      add_chart("Absorption", "albedo-" + field,
                {"sphere of 20 transport mean free paths, source " + field, "1 - albedo",
                 "largest error / largest |u|", true, true,
                 series_of(
                     all_,
                     [&](const Trial& t) {
                       return t.study == "albedo" && t.field == field && t.noise == 0.0;
                     },
                     [](const Trial& t) { return t.method; }, value_of, error_of)},
                "");
  }

  void widths() {
    std::vector<HeatMap> maps;
    for (const double noise : {0.0, 1e-3})
      maps.push_back(map_of(
          all_, [&](const Trial& t) { return t.study == "width" && t.noise == noise; },
          "gaussian, " + noise_words(noise), lambda_R_of, "lambda R", error_of));
    add("Dual reciprocity: width of the Gaussians", "width",
        heat_maps_svg(maps, maps.size(), {1e-4, 10.0, error_scale.label}),
        "Sphere; source that dies out over 0.17 / lambda, as light does at albedo 0.99.");
  }

  void radial_functions() {
    for (const double noise : {0.0, 1e-3})
      add_chart("Dual reciprocity: radial functions",
                fmt::format("radial-{}", noise == 0.0 ? "exact" : "noisy"),
                {"dual reciprocity, " + noise_words(noise), "thickness of the source's layer / R",
                 "largest error / largest |u|", true, true,
                 series_of(
                     all_, [&](const Trial& t) { return t.study == "radial" && t.noise == noise; },
                     [](const Trial& t) { return t.method; }, value_of, error_of)},
                "Sphere; eight knot spacings wide, where there is a width.");
  }

  // Errors of the whole program, with all that is not trusted left out beside it.
  void scenes() {
    HeatMap all{"true error", "", "", {}, {}, {}}, trusted{"trusted only", "", "", {}, {}, {}};
    for (const ExtremeTrial& t : stability_.extremes) {
      if (std::find(all.x.begin(), all.x.end(), t.method) == all.x.end())
        all.x.push_back(t.method == "bkm_thesis" ? "thesis" : t.method);
      if (all.y.empty() || all.y.back() != t.scene) all.y.push_back(t.scene);
      all.values.push_back(t.error);
      trusted.values.push_back(t.exit_code == 0 ? t.error : nan);
    }
    all.x.resize(all.values.size() / all.y.size());
    trusted.x = all.x;
    trusted.y = all.y;
    add("Scenes that ask for trouble", "scenes",
        heat_maps_svg({all, trusted}, 2, {1e-3, 1.0, "relative L2 error of U_d on the surface"}),
        "");
  }

  const Stability& stability_;
  const std::vector<Trial>& all_;
  std::vector<StabilityFigure> figures_;
};

}  // namespace

std::vector<StabilityFigure> stability_figures(const Stability& stability) {
  return Figures(stability).draw();
}

}  // namespace knotlight
