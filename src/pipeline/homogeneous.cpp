#include "pipeline/homogeneous.h"

#include <algorithm>
#include <cmath>

#include "pipeline/residual_effect.h"

namespace knotlight {
namespace {

constexpr std::size_t check_points = 2048;  // the rms of a residual to 2 %, on smooth surfaces
constexpr std::size_t fields_per_chunk = 64;

// Charges are spread over balls whose bias is this share of the tolerance: 0.35 (radius sigma_t)^2
// of U_d on spheres of 5 to 50 mean free paths (docs/results/boundary-methods.md), and 0.85 (radius
// / R)^2 on balls of radius R smaller than a mean free path (docs/results/stability.md).
constexpr double smoothing_share = 0.1;
constexpr double smoothing_bias = 0.35;
constexpr double small_body_bias = 0.85;
// Ends of flights are raised out of the body, by two mean distances between them or by k/2 at most
// (photon_sources.cpp); balls about them that reached into it would be sources there. Half of that.
constexpr double clear_of_ends = 1.0;
constexpr double clear_of_ends_in_k = 0.25;
// The difference of two halves is itself a random number, and what is wanted is a bound that holds
// nearly always: 1.3 standard deviations of an rms over hundreds of independent places.
constexpr double noise_factor = 1.3;

constexpr double residual_share = 0.5;  // of the tolerance
// What a residual does to the field is known next to a plane; thin limbs smooth it less: by a
// quarter on bunny and knot.
constexpr double thin_limb_factor = 1.25;

// Bias by balls of radius 1, 1/length^2.
double smoothing_bias_of(const ChannelProblem& p) {
  const double R = 3.0 * volume(p.shape) / surface_area(p.shape);  // of a ball
  return smoothing_bias * p.medium.sigma_t() * p.medium.sigma_t() + small_body_bias / (R * R);
}

// Tree code and smoothing for a solution of the tolerance that the scene asks for.
PhotonSumOptions particular_options(const ChannelProblem& p) {
  PhotonSumOptions options;
  const double share = smoothing_share * p.settings.tolerance;
  options.softening = std::sqrt(share / smoothing_bias_of(p));
  for (const IncidentHalf& half : p.light.halves) {
    if (half.ends.empty()) continue;
    const double between = std::sqrt(surface_area(p.shape) / static_cast<double>(half.ends.size()));
    options.softening = std::min(
        {options.softening, clear_of_ends * between, clear_of_ends_in_k * p.coefficients.k});
  }
  return options;
}

}  // namespace

BoundaryStart boundary_start(const ChannelProblem& p) {
  BoundaryStart start;
  start.particular = std::make_shared<const ParticularSolution>(p, particular_options(p));
  BoundaryChecks& checks = start.checks;
  checks.at = columns(
      stratified_surface_points(p.shape, check_points, true, p.seed + 3, Stream::check_points));
  checks.particular =
      start.particular->evaluate(checks.at.positions, &checks.at.normals, p.workers);
  checks.data = boundary_data(p, checks.particular, checks.at, p.seed + 3);
  return start;
}

double residual_wanted(const ChannelProblem& p) {
  return residual_share * p.settings.tolerance;
}

BoundaryVerdict judge_boundary(const ChannelProblem& p, const BoundaryChecks& checks,
                               const std::array<HomogeneousPart, 2>& halves) {
  const Eigen::Index n = checks.at.positions.cols();
  std::array<Eigen::VectorXd, 2> u, residual;
  for (std::size_t half = 0; half < 2; ++half) {
    u[half] = checks.particular.value[half];
    residual[half] = checks.data.g[half];
    p.workers.for_chunks(static_cast<std::size_t>(n), fields_per_chunk,
                         [&](std::size_t, std::size_t begin, std::size_t end) {
                           for (auto i = static_cast<Eigen::Index>(begin);
                                i < static_cast<Eigen::Index>(end); ++i) {
                             const Vec3 x = checks.at.positions.col(i);
                             u[half][i] += halves[half].value(x);
                             residual[half][i] -= halves[half].robin(x, checks.at.normals.col(i));
                           }
                         });
  }
  BoundaryVerdict verdict;
  verdict.scale = root_mean_square(0.5 * (u[0] + u[1]));
  verdict.noise = relative(root_mean_square(0.5 * (u[0] - u[1])), verdict.scale);
  // Noise of the halves is independent and drops out of the mean product.
  const double common = std::abs(residual[0].dot(residual[1])) / static_cast<double>(n);
  verdict.robin_residual = relative(std::sqrt(common), verdict.scale);
  const double effect =
      std::sqrt(mean_square_effect(checks.at.positions, residual, p.coefficients.k, p.workers));
  verdict.solver_error =
      std::min(verdict.robin_residual, thin_limb_factor * relative(effect, verdict.scale));
  verdict.largest_residual =
      relative(0.5 * (residual[0] + residual[1]).cwiseAbs().maxCoeff(), verdict.scale);
  return verdict;
}

ChannelSolution boundary_solution(const ChannelProblem& p,
                                  std::shared_ptr<const ParticularSolution> particular,
                                  const BoundaryVerdict& verdict, HomogeneousPart mean) {
  ChannelSolution solution;
  const double radius = particular_options(p).softening;
  solution.numerical_error = verdict.solver_error + smoothing_bias_of(p) * radius * radius;
  solution.noise = noise_factor * verdict.noise;
  solution.solved = std::isfinite(verdict.scale);
  if (!solution.solved) solution.failures.push_back("the solution has values that are not finite");
  solution.figures = {{"charges", static_cast<double>(particular->charges())},
                      {"robin_residual", verdict.robin_residual},
                      {"largest_robin_residual", verdict.largest_residual}};
  solution.U_d = [particular = std::move(particular), mean = std::move(mean)](const Points& x) {
    const ParticularValues up = particular->evaluate(x, nullptr, Workers(1));
    Eigen::VectorXd u = 0.5 * (up.value[0] + up.value[1]);
    for (Eigen::Index i = 0; i < u.size(); ++i) u[i] += mean.value(x.col(i));
    return u;
  };
  return solution;
}

}  // namespace knotlight
