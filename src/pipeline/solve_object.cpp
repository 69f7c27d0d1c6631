#include "pipeline/solve_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/plan.h"
#include "pipeline/sample_points.h"
#include "pipeline/solve_bkm_thesis.h"
#include "pipeline/solve_boundary.h"
#include "pipeline/solve_global.h"
#include "pipeline/solve_grid.h"
#include "pipeline/solve_lbkm.h"

namespace knotlight {
namespace {

constexpr std::size_t boundary_samples = 4096;  // of the leaving flux: strata, so well below 0.1 %
constexpr std::size_t volume_samples = 4096;    // of the absorption: 1-2 % of it
// Exit code 3 beyond this many tolerances: the tolerance is aimed at, not promised.
constexpr double tolerances_allowed = 3.0;
constexpr double sampling_deviations = 4.0;  // of the volume integral: one false alarm in 16 000

// To lights of some extent, per surface point of a picture: noise well below the tolerance.
constexpr int rays_per_surface_point = 256;

// Power that the source model hands to the diffusion equation, W.
double power_in(const ChannelProblem& p) {
  const double scattered = p.medium.albedo() * p.light.photon_power();
  const double emitted = p.medium.emission * volume(p.shape);
  switch (p.light.model) {
    case SourceModel::photon_map:
    case SourceModel::irradiance_thesis:  // which has no power: nothing to balance it with
      return scattered + emitted;
    case SourceModel::irradiance_sampling:
      return scattered + emitted + p.medium.reduced_albedo() * p.light.entered_power();
    case SourceModel::boundary_flux:
      return scattered + emitted + p.light.entered_power();
  }
  return 0.0;
}

// The terms of the energy balance, docs/theory.md section 4.
void balance_energy(const ChannelProblem& p, const SolvedChannel& solved, ChannelReport& report) {
  const FieldValues& U_d = solved.U_d;
  const double solid = volume(p.shape);
  const SurfaceSamples surface = columns(
      stratified_surface_points(p.shape, boundary_samples, true, p.seed + 2, Stream::check_points));
  const Eigen::VectorXd inside =
      U_d(volume_points(p.shape, p.caster, p.object, volume_samples, p.seed));
  // None found, in an object that fills nothing of its box: not-a-number, which fails the check.
  const double mean = inside.sum() / static_cast<double>(inside.size());
  const double deviation =
      std::sqrt((inside.array() - mean).square().sum() / static_cast<double>(inside.size()));
  const double absorbed_per_U = 4.0 * std::numbers::pi * p.medium.sigma_a * solid;
  report.power_in = power_in(p);
  report.power_leaving =
      p.coefficients.leaving_flux(leaving_U_d(solved, p.scene, p.caster, p.object, p.channel,
                                              surface.positions, surface.normals, p.seed + 2)
                                      .mean()) *
      surface_area(p.shape);
  report.power_absorbed = absorbed_per_U * mean;
  report.energy_imbalance =
      relative(report.power_leaving + report.power_absorbed - report.power_in, report.power_in);
  report.energy_imbalance_standard_error = relative(
      absorbed_per_U * deviation / std::sqrt(static_cast<double>(inside.size())), report.power_in);
}

constexpr double largest_blind_zone = 0.01;  // mean free paths: 1 % of the light at a surface

// With fewer photons even "no light gets here" cannot be told from bad luck: three in so many is
// the 95 % bound on a share of the light of which none was seen.
constexpr std::size_t least_photons = 10'000;

// Irradiance samples that see light: a patch lit by fewer is known to 10 % or worse, and none may
// be bad luck too.
constexpr std::size_t least_lit_samples = 100;

ChannelSolution solve_by(Method method, const ChannelProblem& problem) {
  switch (method) {
    case Method::bkm_thesis:
      return solve_by_bkm_thesis(problem);
    case Method::bkm:
      return solve_by_bkm(problem, boundary_start(problem));
    case Method::mfs:
      return solve_by_mfs(problem, boundary_start(problem));
    case Method::lbkm:
      return solve_by_lbkm(problem, boundary_start(problem));
    case Method::grid:
      return solve_by_grid(problem);
    case Method::automatic:
      return solve_by_boundary(problem);
  }
  return {};
}

// Comparisons are written so that not-a-number fails.
void judge(const ChannelReport& r, double tolerance, std::vector<std::string>& failures) {
  const double allowed = tolerances_allowed * tolerance;
  if (!(r.error_estimate <= allowed))
    failures.push_back(
        fmt::format("error estimate {:.3g} (solver at most {:.3g}, photon noise {:.3g}) exceeds "
                    "{:.3g} = {} x tolerance",
                    r.error_estimate, r.numerical_error, r.noise, allowed, tolerances_allowed));
  const double energy_slack = allowed + sampling_deviations * r.energy_imbalance_standard_error;
  if (!(std::abs(r.energy_imbalance) <= energy_slack))
    failures.push_back(fmt::format("energy balance is off by {:.3g}, allowed {:.3g}",
                                   r.energy_imbalance, energy_slack));
}

}  // namespace

bool enough_photons(const Scene& scene) {
  return scene.lights.empty() || scene.solver.photons >= least_photons;
}

std::string too_few_photons(const Scene& scene) {
  return fmt::format("{} photons are too few to judge anything by, expected {}",
                     scene.solver.photons, least_photons);
}

Eigen::VectorXd leaving_U_d(const SolvedChannel& channel, const Scene& scene,
                            const RayCaster& caster, std::uint32_t object, int channel_index,
                            const Points& positions, const Points& normals, std::uint64_t seed) {
  Eigen::VectorXd values = channel.U_d(positions);
  if (channel.model != SourceModel::boundary_flux) return values;
  const Eigen::VectorXd light =
      entering_irradiances(scene, caster, channel_index, object, {positions, normals},
                           rays_per_surface_point, seed, Workers(1));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] -= DiffusionCoefficients::boundary_flux_U_ri(light[i]);
  return values;
}

SolvedChannel solve_channel(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                            int channel, const Equation& equation, Method method,
                            const ObjectGrids* grids, const IncidentLight& light,
                            std::uint64_t seed, const Workers& workers, FactorCache& factors) {
  const Medium& medium = equation.medium;
  const DiffusionCoefficients& coefficients = equation.coefficients;
  SolvedChannel result;
  result.model = light.model;
  result.equation = equation;
  const ChannelProblem problem{scene,        scene.objects[object].shape,
                               channel,      medium,
                               coefficients, scene.solver,
                               light,        grids,
                               caster,       object,
                               seed,         workers,
                               factors};
  ChannelReport& report = result.report;
  report.lambda = coefficients.lambda;
  report.k = coefficients.k;
  report.photons = light.photons();
  report.photon_power = light.photon_power();
  report.entered_power = light.entered_power();

  ChannelSolution solution = solve_by(method, problem);
  result.solved = solution.solved;
  result.U_d = solution.solved ? std::move(solution.U_d) : [](const Points& x) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(x.cols(), std::numeric_limits<double>::quiet_NaN());
  };
  if (solution.solved) result.on_grid = std::move(solution.on_grid);
  report.method = name_of(solution.method);
  report.figures = std::move(solution.figures);
  report.numerical_error = solution.numerical_error;
  report.noise = solution.noise;
  balance_energy(problem, result, report);
  // The boundary methods know their residual on the surface, but not sources that are misplaced:
  // energy does. The other methods balance it by construction, or bound their error otherwise.
  if (solution.method == Method::bkm || solution.method == Method::mfs ||
      solution.method == Method::lbkm)
    report.numerical_error += std::max(
        0.0, std::abs(report.energy_imbalance) - 2.0 * report.energy_imbalance_standard_error);
  report.error_estimate = report.numerical_error + report.noise;
  result.failures = std::move(solution.failures);
  if ((light.model == SourceModel::photon_map || light.has_walks) && !enough_photons(scene))
    result.failures.push_back(too_few_photons(scene));
  const bool samples_irradiance =
      light.model == SourceModel::irradiance_sampling || light.model == SourceModel::boundary_flux;
  if (samples_irradiance && !scene.lights.empty() && light.lit_samples() < least_lit_samples)
    result.failures.push_back(
        fmt::format("light reaches {} of the irradiance samples, too few to judge anything by, "
                    "expected {}",
                    light.lit_samples(), least_lit_samples));
  const double blind = caster.touching_distance() * medium.sigma_t();
  if (!(blind <= largest_blind_zone))
    result.failures.push_back(fmt::format(
        "the scene is so large that rays cannot tell surfaces {:.2g} mean free paths apart, "
        "expected at most {}: bring its far objects nearer",
        blind, largest_blind_zone));
  judge(report, scene.solver.tolerance, result.failures);
  return result;
}

}  // namespace knotlight
