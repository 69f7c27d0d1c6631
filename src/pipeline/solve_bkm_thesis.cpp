#include "pipeline/solve_bkm_thesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bkm/certificate.h"
#include "bkm/knots.h"
#include "bkm/shape_parameter.h"
#include "bkm/thesis_solver.h"
#include "photon/source_terms.h"
#include "pipeline/sample_points.h"

namespace knotlight {
namespace {

constexpr std::size_t default_knots = 484;  // the thesis's usual number [V09 fig. 7.2]
constexpr std::size_t layer_checks = 1024;
constexpr std::size_t volume_checks = 1024;
// Of the interior check points, some lie at random depths down to this many transport mean free
// paths, where the source lives and changes fastest, the others anywhere: what dual reciprocity
// makes of the source where there are no knots is part of its error.
constexpr double check_depth = 3.0;

// A set of points with the right-hand sides there.
struct PointSets {
  SurfaceSamples surface;
  Points interior;
};

struct RightHandSides {
  SourceTerms halves[2];

  Eigen::VectorXd f() const { return 0.5 * (halves[0].f + halves[1].f); }
  Eigen::VectorXd g() const { return 0.5 * (halves[0].g + halves[1].g); }
};

constexpr int rays_per_sample = 256;  // to lights of some extent: no neighbour evens out its noise

// The thesis's irradiance sampling: the light that enters at a knot becomes the value
// exp(-sigma_t l) E / (4 pi) of an isotropic source at the knot l = 1/sigma_tr below it, and the
// source is zero at all other knots [V09 6.21-6.24]: f = -3 sigma_tr times that value.
void add_thesis_irradiance(SourceTerms& terms, const PointSets& knots, const Eigen::VectorXd& light,
                           const ChannelProblem& p) {
  const double depth = 1.0 / p.medium.sigma_tr();
  const double per_light =
      -3.0 * p.medium.sigma_tr() * std::exp(-p.medium.sigma_t() * depth) / (4.0 * std::numbers::pi);
  // The first layer of interior knots, in the order of the boundary knots, less those outside.
  Eigen::Index row = knots.surface.positions.cols();
  for (Eigen::Index i = 0; i < light.size(); ++i) {
    const Vec3 x = knots.surface.positions.col(i) - depth * knots.surface.normals.col(i);
    if (p.caster.inside(x, p.object)) terms.f[row++] += per_light * light[i];
  }
}

RightHandSides right_hand_sides(const PointSets& places, const VolumePhotonMap (&maps)[2],
                                bool at_knots, const ChannelProblem& p) {
  SourceTermOptions options;
  options.boundary = p.settings.boundary;
  options.divergence = p.settings.divergence;
  RightHandSides result;
  for (std::size_t half = 0; half < 2; ++half) {
    SourceTerms& terms = result.halves[half];
    options.estimate = estimate_options(p.settings, maps[half].size(), p.medium);
    terms = source_terms(places.surface.positions, places.surface.normals, places.interior,
                         maps[half], p.medium, options, p.caster, p.object, p.workers);
    if (p.light.model == SourceModel::photon_map) continue;
    const Eigen::VectorXd light =
        entering_irradiances(p.scene, p.caster, p.channel, p.object, places.surface,
                             rays_per_sample, p.seed + half, p.workers);
    if (p.light.model == SourceModel::boundary_flux)
      for (Eigen::Index i = 0; i < light.size(); ++i)
        terms.g[i] += p.coefficients.boundary_flux_data(light[i]);
    else if (at_knots)
      add_thesis_irradiance(terms, places, light, p);
  }
  return result;
}

// Points that are not knots: on the surface, in the layer below it, and in the whole volume. Those
// of the layer that would lie outside are left out.
PointSets check_places(const ChannelProblem& p) {
  PointSets places{boundary_check_points(p), {}};
  const SurfaceSamples roots = columns(
      stratified_surface_points(p.shape, layer_checks, true, p.seed + 1, Stream::check_points));
  const double depth = check_depth / p.medium.sigma_tr();
  Rng rng(p.seed, Stream::check_depths, p.object);
  Points points(3, roots.positions.cols() + static_cast<Eigen::Index>(volume_checks));
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < roots.positions.cols(); ++i) {
    const Vec3 x = roots.positions.col(i) - depth * rng.uniform() * roots.normals.col(i);
    if (p.caster.inside(x, p.object)) points.col(count++) = x;
  }
  const Points anywhere = volume_points(p.shape, p.caster, p.object, volume_checks, p.seed + 1);
  points.middleCols(count, anywhere.cols()) = anywhere;
  places.interior = points.leftCols(count + anywhere.cols());
  return places;
}

double largest(const Eigen::VectorXd& v) {
  return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
}

// Boundary and interior knots [V09 ch. 7].
PointSets knot_places(const ChannelProblem& p, std::size_t count, std::size_t& dropped) {
  const BkmThesisSettings& settings = p.settings.thesis;
  SurfaceSamples surface = surface_knots(p.shape, settings.knot_layout, count, p.seed);
  const auto inside = [&](const Vec3& x) { return p.caster.inside(x, p.object); };
  InteriorKnots interior;
  if (settings.interior_knots == InteriorLayout::grid) {
    // As many as two layers have.
    interior = grid_knots(surface.positions, volume(p.shape),
                          2 * static_cast<std::size_t>(surface.positions.cols()), inside);
    dropped = 0;  // the corners of the box around the object are no knots that it lacks
  } else {
    std::vector<double> depths = layer_depths(settings.interior_knots);
    for (double& depth : depths) depth /= p.medium.sigma_tr();
    interior = interior_knots(surface.positions, surface.normals, depths, inside);
    dropped = interior.dropped;
  }
  return {std::move(surface), interior.points};
}

// Exponents of the two multiquadrics where the scene gives none: Hardy's, and that of the thesis's
// pictures [V09 fig. 7.9].
double default_exponent(RadialKind kind) {
  return kind == RadialKind::inverse_multiquadric ? 3.0 : 1.0;
}

// `chosen` tells what leave-one-out found, if it was asked for.
BkmThesisOptions thesis_options(const ChannelProblem& p, const BkmThesisProblem& problem,
                                const Eigen::VectorXd& f, ShapeChoice& chosen) {
  const BkmThesisSettings& settings = p.settings.thesis;
  BkmThesisOptions options;
  options.radial = settings.radial_function;
  options.exponent = settings.radial_exponent.value_or(default_exponent(options.radial));
  options.radial_order = settings.radial_order;
  options.basis_order = settings.basis_order;
  options.solver = settings.dense_solver;
  options.precision = settings.distance_precision;
  options.workers = p.workers;
  if (settings.svd_cut) options.relative_cut = *settings.svd_cut;
  const double spacing = mean_knot_spacing(
      surface_area(p.shape), static_cast<std::size_t>(problem.boundary_points.cols()));
  options.c = settings.shape_parameter.value_or(default_shape_parameter()) * spacing;
  if (!settings.leave_one_out) return options;
  chosen = leave_one_out_width(
      all_points(problem), f,
      radial_function(options, problem.lambda, diameter(problem.boundary_points)), spacing,
      {options.precision, options.workers},
      {options.solver, options.relative_cut, options.workers});
  options.c = chosen.c;
  return options;
}

}  // namespace

ChannelSolution solve_by_bkm_thesis(const ChannelProblem& p) {
  ChannelSolution solution;
  solution.method = Method::bkm_thesis;

  const std::size_t wanted = p.settings.knots.value_or(default_knots);
  std::size_t dropped = 0;
  const PointSets knots = knot_places(p, wanted, dropped);
  const auto count = static_cast<std::size_t>(knots.surface.positions.cols());

  const VolumePhotonMap maps[2] = {VolumePhotonMap(p.light.halves[0].photons, p.medium),
                                   VolumePhotonMap(p.light.halves[1].photons, p.medium)};
  const RightHandSides at_knots = right_hand_sides(knots, maps, true, p);

  const BkmThesisProblem problem{p.coefficients.lambda, p.coefficients.k, knots.surface.positions,
                                 knots.surface.normals, knots.interior};
  ShapeChoice chosen;
  const BkmThesisOptions options = thesis_options(p, problem, at_knots.f(), chosen);
  const BkmThesisSolver solver(problem, options);
  BkmSolveFigures systems;
  const BkmField field = solver.solve(at_knots.f(), at_knots.g(), systems);
  const BkmField half_field = solver.solve(at_knots.halves[0].f, at_knots.halves[0].g);

  const PointSets checks = check_places(p);
  const RightHandSides at_checks = right_hand_sides(checks, maps, false, p);
  const Eigen::VectorXd f = at_checks.f().tail(checks.interior.cols());
  const Certificate certificate =
      certify(field, problem, checks.surface.positions, checks.surface.normals, at_checks.g(),
              checks.interior, f);
  solution.numerical_error = certificate.error_estimate;
  solution.noise = relative(root_mean_square(half_field.values(checks.surface.positions) -
                                             field.values(checks.surface.positions)),
                            certificate.scale);
  solution.solved = solver.ok() && certificate.trusted;
  if (!solver.ok())
    solution.failures.push_back("the linear systems could not be solved: " + solver.message());
  else if (!certificate.trusted)
    solution.failures.push_back("the solution has values that are not finite");
  if (p.light.model == SourceModel::irradiance_thesis)
    solution.failures.push_back(
        "the thesis's irradiance source is a value at knots, not a power density: what it adds up "
        "to depends on the number of knots");
  const std::size_t interior_wanted = dropped + static_cast<std::size_t>(knots.interior.cols());
  if (2 * dropped > interior_wanted)
    solution.failures.push_back(
        fmt::format("{} of {} interior knots would lie outside: the object is too thin for them",
                    dropped, interior_wanted));

  solution.figures = {
      {"boundary_knots", static_cast<double>(count)},
      {"interior_knots", static_cast<double>(knots.interior.cols())},
      {"interior_knots_dropped", static_cast<double>(dropped)},
      {"radial_width", has_width(options.radial) ? options.c : 0.0},
      {"leave_one_out_error", relative(chosen.error, root_mean_square(at_knots.f()))},
      {"leave_one_out_factorisations", static_cast<double>(chosen.factorisations)},
      {"particular_rank", solver.particular_rank()},
      {"homogeneous_rank", solver.homogeneous_rank()},
      {"particular_condition", solver.particular_condition()},
      {"homogeneous_condition", solver.homogeneous_condition()},
      {"particular_effective_condition", systems.particular_effective_condition},
      {"homogeneous_effective_condition", systems.homogeneous_effective_condition},
      {"particular_regulariser", systems.particular_regulariser},
      {"homogeneous_regulariser", systems.homogeneous_regulariser},
      {"robin_residual", relative(certificate.robin_residual_max, certificate.scale)},
      {"source_residual", relative(certificate.source_residual_max, largest(f))}};
  solution.U_d = [field](const Points& x) { return field.values(x); };
  return solution;
}

}  // namespace knotlight
