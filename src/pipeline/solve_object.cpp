#include "pipeline/solve_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bkm/certificate.h"
#include "bkm/knots.h"
#include "photon/source_terms.h"
#include "pipeline/sample_points.h"

namespace knotlight {
namespace {

constexpr std::size_t default_knots = 484;  // the thesis's usual number [V09 fig. 7.2]
constexpr std::size_t boundary_checks = 512;
constexpr std::size_t interior_checks = 1024;
// Interior check points lie at random depths down to this many transport mean free paths, where the
// source lives and changes fastest.
constexpr double check_depth = 3.0;
constexpr std::size_t volume_checks =
    4096;  // for the energy balance; 1-2 % per point, 0.02 % in all
// Exit code 3 beyond this many tolerances: the tolerance is aimed at, not promised.
constexpr double tolerances_allowed = 3.0;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double sampling_deviations = 4.0;  // of the volume integral: one false alarm in 16 000

SourceTermOptions source_options(const SolverSettings& settings) {
  SourceTermOptions options;
  options.estimate = estimate_options(settings);
  options.boundary = settings.boundary;
  options.divergence = settings.divergence;
  return options;
}

// Points below the surface points at random depths; those that would lie outside are left out.
Points below_surface(const SurfaceSamples& surface, double depth, const RayCaster& caster,
                     std::uint32_t object, std::uint64_t seed) {
  Points points(3, surface.positions.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < surface.positions.cols(); ++i) {
    Rng rng(seed, Stream::check_points, static_cast<std::uint64_t>(i));
    const Vec3 p = surface.positions.col(i) - depth * rng.uniform() * surface.normals.col(i);
    if (caster.inside(p, object)) points.col(count++) = p;
  }
  return points.leftCols(count);
}

// Points that are not knots: on the surface, and inside where the source lives.
struct CheckPlaces {
  SurfaceSamples surface;
  Points interior;
};

CheckPlaces check_places(const Shape& shape, const Medium& medium, const RayCaster& caster,
                         std::uint32_t object, std::uint64_t seed) {
  const auto surface =
      stratified_surface_points(shape, boundary_checks, true, seed, Stream::check_points);
  const auto roots =
      stratified_surface_points(shape, interior_checks, true, seed + 1, Stream::check_points);
  return {columns(surface),
          below_surface(columns(roots), check_depth / medium.sigma_tr(), caster, object, seed)};
}

// 0/0 = 0: an object that no light reaches is dark, and that is exact.
double relative(double part, double whole) {
  return part == 0.0 ? 0.0 : part / whole;
}

double rms(const Eigen::VectorXd& v) {
  return std::sqrt(v.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, v.size())));
}

// The terms of the energy balance, docs/theory.md section 4.
void check_energy(const BkmField& field, const Shape& shape, const Medium& medium,
                  const DiffusionCoefficients& coefficients, const SurfaceSamples& surface,
                  const RayCaster& caster, std::uint32_t object, std::uint64_t seed,
                  ChannelReport& report) {
  const double solid = volume(shape);
  const Eigen::VectorXd inside =
      field.values(volume_points(shape, caster, object, volume_checks, seed));
  const double mean = inside.mean();
  const double deviation = rms(inside.array() - mean);
  const double absorbed_per_U = 4.0 * std::numbers::pi * medium.sigma_a * solid;
  report.power_in = medium.albedo() * report.photon_power + medium.emission * solid;
  report.power_leaving =
      coefficients.leaving_flux(field.values(surface.positions).mean()) * surface_area(shape);
  report.power_absorbed = absorbed_per_U * mean;
  report.energy_imbalance =
      relative(report.power_leaving + report.power_absorbed - report.power_in, report.power_in);
  report.energy_imbalance_standard_error = relative(
      absorbed_per_U * deviation / std::sqrt(static_cast<double>(inside.size())), report.power_in);
}

std::vector<std::string> failed_checks(const ChannelReport& r, const BkmThesisSolver& solver,
                                       const SolverSettings& settings) {
  const double allowed = tolerances_allowed * settings.tolerance;
  std::vector<std::string> failures;
  if (!solver.ok())
    failures.push_back("the linear systems could not be solved: " + solver.message());
  // Written so that not-a-number fails.
  if (!(r.error_estimate <= allowed))
    failures.push_back(
        fmt::format("error estimate {:.3g} (solver at most {:.3g}, photon noise {:.3g}) exceeds "
                    "{:.3g} = {} x tolerance",
                    r.error_estimate, r.numerical_error, r.noise, allowed, tolerances_allowed));
  const double energy_slack = allowed + sampling_deviations * r.energy_imbalance_standard_error;
  if (!(std::abs(r.energy_imbalance) <= energy_slack))
    failures.push_back(fmt::format("energy balance is off by {:.3g}, allowed {:.3g}",
                                   r.energy_imbalance, energy_slack));
  if (r.interior_knots_dropped > r.boundary_knots)
    failures.push_back(
        fmt::format("{} of {} interior knots would lie outside: the object is too thin for them",
                    r.interior_knots_dropped, r.interior_knots_dropped + r.interior_knots));
  return failures;
}

}  // namespace

EstimateOptions estimate_options(const SolverSettings& settings) {
  EstimateOptions options;
  if (settings.estimate_photons) options.nearest = *settings.estimate_photons;
  return options;
}

PhotonHalves::PhotonHalves(std::vector<VolumePhoton> photons, const Medium& medium) {
  std::vector<VolumePhoton> even;
  std::vector<VolumePhoton> odd;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    photons[i].power *= 2.0;
    (i % 2 == 0 ? even : odd).push_back(photons[i]);
  }
  maps.emplace_back(std::move(even), medium);
  maps.emplace_back(std::move(odd), medium);
}

double PhotonHalves::U_ri(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
                          std::uint32_t object) const {
  return 0.5 * (maps[0].estimate(x, options, caster, object).U_ri +
                maps[1].estimate(x, options, caster, object).U_ri);
}

SolvedChannel solve_channel(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                            int channel, std::vector<VolumePhoton> photons, std::uint64_t seed,
                            const Workers& workers) {
  const Shape& shape = scene.objects[object].shape;
  const Medium medium = scene.objects[object].translucent()->medium(channel);
  const SolverSettings& settings = scene.solver;
  const DiffusionCoefficients coefficients = diffusion_coefficients(medium, settings.boundary);
  SolvedChannel result{PhotonHalves(std::move(photons), medium), {}, {}, {}};
  ChannelReport& report = result.report;
  report.lambda = coefficients.lambda;
  report.k = coefficients.k;
  report.photons = result.photons.size();
  report.photon_power = result.photons.total_power();

  // Knots [V09 ch. 7]: strata of the surface, and 1 and 3/2 transport mean free paths below them.
  const std::size_t knots = settings.knots.value_or(default_knots);
  const SurfaceSamples surface = columns(
      stratified_surface_points(shape, knots, settings.jitter, seed, Stream::boundary_knots));
  const double mean_free_path = 1.0 / medium.sigma_tr();
  const InteriorKnots interior =
      interior_knots(surface.positions, surface.normals, {mean_free_path, 1.5 * mean_free_path},
                     [&](const Vec3& p) { return caster.inside(p, object); });
  report.boundary_knots = knots;
  report.interior_knots = static_cast<std::size_t>(interior.points.cols());
  report.interior_knots_dropped = interior.dropped;

  const BkmThesisProblem problem{coefficients.lambda, coefficients.k, surface.positions,
                                 surface.normals, interior.points};
  const double spacing = mean_knot_spacing(surface_area(shape), knots);
  BkmThesisOptions options;
  options.c = settings.shape_parameter.value_or(default_shape_parameter()) * spacing;
  if (settings.svd_cut) options.relative_cut = *settings.svd_cut;
  report.gaussian_width = options.c;
  const BkmThesisSolver solver(problem, options);
  report.particular_rank = solver.particular_rank();
  report.homogeneous_rank = solver.homogeneous_rank();
  report.particular_condition = solver.particular_condition();
  report.homogeneous_condition = solver.homogeneous_condition();

  const CheckPlaces checks = check_places(shape, medium, caster, object, seed);
  SourceTerms at_knots[2];
  SourceTerms at_checks[2];
  for (std::size_t half = 0; half < 2; ++half) {
    const VolumePhotonMap& map = result.photons.maps[half];
    const SourceTermOptions terms = source_options(settings);
    at_knots[half] = source_terms(surface.positions, surface.normals, interior.points, map, medium,
                                  terms, caster, object, workers);
    at_checks[half] = source_terms(checks.surface.positions, checks.surface.normals,
                                   checks.interior, map, medium, terms, caster, object, workers);
  }
  const auto mean = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
    return 0.5 * (a + b);
  };
  result.field =
      solver.solve(mean(at_knots[0].f, at_knots[1].f), mean(at_knots[0].g, at_knots[1].g));
  const BkmField half_field = solver.solve(at_knots[0].f, at_knots[0].g);

  const Eigen::VectorXd g = mean(at_checks[0].g, at_checks[1].g);
  const Eigen::VectorXd f = mean(at_checks[0].f, at_checks[1].f).tail(checks.interior.cols());
  const Certificate certificate = certify(result.field, problem, checks.surface.positions,
                                          checks.surface.normals, g, checks.interior, f);
  const Eigen::VectorXd half_difference =
      half_field.values(checks.surface.positions) - result.field.values(checks.surface.positions);
  report.robin_residual = relative(certificate.robin_residual_max, certificate.scale);
  report.source_residual =
      relative(certificate.source_residual_max, f.size() > 0 ? f.cwiseAbs().maxCoeff() : 0.0);
  // Relative to the least that the true field can be: a field that is all error would otherwise
  // call itself 100 % off.
  const double least_scale = certificate.scale - certificate.error_bound;
  report.numerical_error = least_scale > 0.0 ? relative(certificate.error_bound, least_scale)
                                             : (certificate.error_bound == 0.0 ? 0.0 : infinity);
  report.noise = relative(rms(half_difference), certificate.scale);
  report.error_estimate = report.numerical_error + report.noise;
  check_energy(result.field, shape, medium, coefficients, checks.surface, caster, object, seed,
               report);
  result.failures = failed_checks(report, solver, settings);
  // The picture is to be written all the same: what could not be solved stays dark in it.
  if (!certificate.trusted) result.field = BkmField();
  return result;
}

}  // namespace knotlight
