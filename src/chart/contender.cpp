#include "chart/contender.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/plan.h"
#include "scene/refracts.h"

namespace knotlight {
namespace {

constexpr std::array<double, 6> tolerances = {0.16, 0.08, 0.04, 0.02, 0.01, 0.005};
// Noise falls at least as photons^(-1/2): with these it keeps step with the tolerance.
constexpr double photons_at_1_percent = 2e6;
constexpr double least_photons = 20'000.0;  // with fewer the program does not trust itself
constexpr std::array<std::size_t, 6> knots = {100, 200, 400, 800, 1600, 3200};
// Dual reciprocity has three times as many unknowns as knots on the surface.
constexpr std::array<std::size_t, 6> thesis_knots = {60, 120, 240, 480, 960, 1600};
constexpr std::array<std::size_t, 6> irradiance_samples = {500,    2'000,   8'000,
                                                           32'000, 128'000, 512'000};
constexpr std::array<std::uint64_t, 6> samples = {1, 4, 16, 64, 256, 1024};
constexpr std::array<double, 6> entries = {0.3, 1.0, 3.0, 10.0, 30.0, 100.0};  // of the dipole

std::size_t photons_for(double tolerance) {
  return static_cast<std::size_t>(
      std::max(least_photons, photons_at_1_percent * std::pow(0.01 / tolerance, 2)));
}

class Lines {
 public:
  Lines(const Scene& scene, int levels) : base_(scene.solver), levels_(levels) {
    // What a scene asks for itself is the default line's alone.
    base_.source = SourceModel::photon_map;
    base_.method = Method::grid;
    base_.exitance = Exitance::gather;
    base_.diffusion = Diffusion::p1;
    base_.photons_at_most = false;
    base_.knots.reset();
    base_.irradiance_samples.reset();
  }

  // change(settings, level) sets what the line is about.
  template <typename Change>
  void add(const std::string& line, const Change& change) {
    for (int level = 0; level < levels_; ++level) {
      const auto l = static_cast<std::size_t>(level);
      SolverSettings settings = base_;
      settings.tolerance = tolerances[l];
      settings.photons = photons_for(tolerances[l]);
      change(settings, l);
      all_.push_back({line, describe(settings), level, Maker::solver, settings});
    }
  }
  void add(Contender contender) {
    if (contender.level < levels_) all_.push_back(std::move(contender));
  }
  std::vector<Contender> in_order() {
    std::stable_sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) {
      return std::pair(!is_ours(a), is_ours(a) ? 0 : a.level) <
             std::pair(!is_ours(b), is_ours(b) ? 0 : b.level);
    });
    return std::move(all_);
  }

 private:
  static bool is_ours(const Contender& contender) {
    return contender.line == default_line || contender.line == our_field_line;
  }
  static std::string describe(const SolverSettings& s) {
    std::string text = fmt::format("tolerance {:g}, {}{} photons", s.tolerance,
                                   s.photons_at_most ? "at most " : "", s.photons);
    if (s.knots) text += fmt::format(", {} knots", *s.knots);
    if (s.irradiance_samples && s.source != SourceModel::photon_map)
      text += fmt::format(", {} irradiance samples", *s.irradiance_samples);
    return text;
  }

  SolverSettings base_;
  int levels_;
  std::vector<Contender> all_;
};

// Fewer photons than keep step, for the front of the method that is taken by default.
void add_photon_steps(Lines& lines) {
  for (const auto& [name, divisor] :
       {std::pair{"a quarter of the photons", 4.0}, std::pair{"a sixteenth of the photons", 16.0}})
    lines.add(fmt::format("grid, {}", name), [d = divisor](SolverSettings& s, std::size_t) {
      s.diffusion = Diffusion::asymptotic;
      s.photons =
          static_cast<std::size_t>(std::max(least_photons, static_cast<double>(s.photons) / d));
    });
}

void add_exitances(Lines& lines) {
  lines.add("grid", [](SolverSettings& s, std::size_t) { s.diffusion = Diffusion::asymptotic; });
  lines.add("grid, grosjean",
            [](SolverSettings& s, std::size_t) { s.diffusion = Diffusion::grosjean; });
  lines.add(our_field_line, [](SolverSettings&, std::size_t) {});
  for (const auto& [name, exitance] :
       {std::pair{"p1 exitance", Exitance::p1}, std::pair{"lambert", Exitance::lambert},
        std::pair{"mean_intensity", Exitance::mean_intensity}})
    lines.add(fmt::format("grid, {}", name),
              [e = exitance](SolverSettings& s, std::size_t) { s.exitance = e; });
}

void add_sources(Lines& lines, bool refracting) {
  for (const SourceModel model : {SourceModel::irradiance_sampling, SourceModel::boundary_flux})
    lines.add(fmt::format("grid, {}", name_of(model)),
              [model, refracting](SolverSettings& s, std::size_t level) {
                s.source = model;
                s.irradiance_samples = irradiance_samples[level];
                // Gathering in refracting objects needs photons inside them.
                if (refracting) s.exitance = Exitance::p1;
              });
}

// Pictures want the equation beyond P1, the field is judged as P1's.
void add_boundary_methods(Lines& lines) {
  for (const Diffusion diffusion : {Diffusion::asymptotic, Diffusion::p1})
    for (const Method method : {Method::lbkm, Method::mfs, Method::bkm})
      lines.add(fmt::format("{}{}", name_of(method), diffusion == Diffusion::p1 ? ", p1" : ""),
                [method, diffusion](SolverSettings& s, std::size_t level) {
                  s.method = method;
                  s.diffusion = diffusion;
                  if (method != Method::lbkm) s.knots = knots[level];  // that has patches instead
                });
}

void add_thesis(Lines& lines) {
  struct Kind {
    const char* name;
    SourceModel source;
    DensityEstimator estimator;
    DistancePrecision precision;
  };
  const std::array<Kind, 5> kinds = {
      {{"photon_map", SourceModel::photon_map, DensityEstimator::nearest,
        DistancePrecision::double_precision},
       {"photon_map, radius estimate", SourceModel::photon_map, DensityEstimator::radius,
        DistancePrecision::double_precision},
       {"photon_map, kernel estimate", SourceModel::photon_map, DensityEstimator::kernel,
        DistancePrecision::double_precision},
       {"photon_map, float distances", SourceModel::photon_map, DensityEstimator::nearest,
        DistancePrecision::single_precision},
       {"irradiance_thesis", SourceModel::irradiance_thesis, DensityEstimator::nearest,
        DistancePrecision::double_precision}}};
  for (const Kind& kind : kinds)
    lines.add(fmt::format("bkm_thesis, {}", kind.name),
              [&kind](SolverSettings& s, std::size_t level) {
                s.method = Method::bkm_thesis;
                s.source = kind.source;
                s.estimator = kind.estimator;
                s.thesis.distance_precision = kind.precision;
                s.knots = thesis_knots[level];
                s.exitance = Exitance::p1;
              });
}

}  // namespace

std::vector<Contender> contenders(const Scene& scene, const SettingsOfTolerance& chosen,
                                  int levels) {
  Lines lines(scene, levels);
  lines.add(default_line,
            [&](SolverSettings& s, std::size_t level) { s = chosen(tolerances[level]); });
  add_exitances(lines);
  add_photon_steps(lines);
  add_sources(lines, anything_refracts(scene));
  add_boundary_methods(lines);
  add_thesis(lines);
  for (std::size_t level = 0; level < samples.size(); ++level) {
    const int l = static_cast<int>(level);
    for (const DipoleForm form : {DipoleForm::classic, DipoleForm::better})
      lines.add({form == DipoleForm::classic ? dipole_line : better_dipole_line,
                 fmt::format("{:g} samples per square mean free path", entries[level]),
                 l,
                 Maker::dipole,
                 {},
                 0,
                 entries[level],
                 form});
    lines.add({path_tracing_line,
               fmt::format("{} per pixel", samples[level]),
               l,
               Maker::reference,
               {},
               samples[level]});
  }
  return lines.in_order();
}

}  // namespace knotlight
