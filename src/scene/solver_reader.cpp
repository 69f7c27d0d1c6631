#include <algorithm>
#include <array>
#include <cmath>

#include "scene/scene_parts.h"

namespace knotlight {
namespace {

// The words of the format. Those marked false are part of it, but not available in this version.
constexpr std::array<Choice<SourceModel>, 4> source_models{{
    {"photon_map", SourceModel::photon_map},
    {"irradiance_sampling", SourceModel::irradiance_sampling},
    {"irradiance_thesis", SourceModel::irradiance_thesis},
    {"boundary_flux", SourceModel::boundary_flux},
}};
constexpr std::array<Choice<Method>, 6> methods{{
    {"auto", Method::automatic},
    {"bkm_thesis", Method::bkm_thesis},
    {"bkm", Method::bkm},
    {"mfs", Method::mfs},
    {"lbkm", Method::lbkm},
    {"grid", Method::grid},
}};
constexpr std::array<Choice<Boundary>, 2> boundaries{{
    {"milne", Boundary::milne},
    {"marshak", Boundary::marshak},
}};
constexpr std::array<Choice<Exitance>, 4> exitances{{
    {"gather", Exitance::gather},
    {"p1", Exitance::p1},
    {"lambert", Exitance::lambert},
    {"mean_intensity", Exitance::mean_intensity},
}};
constexpr std::array<Choice<Diffusion>, 3> diffusions{{
    {"asymptotic", Diffusion::asymptotic},
    {"grosjean", Diffusion::grosjean},
    {"p1", Diffusion::p1},
}};
constexpr std::array<Choice<Divergence>, 2> divergences{{
    {"identity", Divergence::identity},
    {"differentiated", Divergence::differentiated},
}};
constexpr std::array<Choice<Deposits>, 2> deposit_rules{{
    {"expected_values", Deposits::expected_values},
    {"collisions", Deposits::collisions},
}};
constexpr std::array<Choice<DensityEstimator>, 3> estimators{{
    {"nearest", DensityEstimator::nearest},
    {"radius", DensityEstimator::radius},
    {"kernel", DensityEstimator::kernel},
}};

// A ball of a thousand mean free paths averages over any object.
constexpr Range estimate_radii{1e-6, 1e3};
constexpr std::size_t max_photons = 500'000'000;            // 32 GB of them
constexpr std::size_t max_irradiance_samples = 10'000'000;  // 0.6 GB of them
constexpr std::size_t max_knots = 5'000;                    // matrices of 15 000 rows, 7 GB
constexpr std::size_t min_knots = 4;                        // four points span a volume
constexpr std::size_t max_estimate_photons = 1'000'000;

// Noise falls about as 1/n; on the shipped scenes this many leave half the tolerance of noise
// (docs/results/expected-values.md).
std::size_t default_photons(double tolerance) {
  constexpr double photons_at_one_per_cent = 2e6;
  constexpr double fewest = 2e5, most = 3e7;
  const double wanted = photons_at_one_per_cent * 0.01 / tolerance;
  return static_cast<std::size_t>(std::clamp(wanted, fewest, most));
}

}  // namespace

SolverSettings read_solver(const YamlNode& node) {
  std::vector<std::string> keys{
      "tolerance",        "source",     "method",          "boundary",
      "exitance",         "diffusion",  "photons",         "knots",
      "estimate_photons", "divergence", "deposits",        "similarity",
      "returning_light",  "estimator",  "estimate_radius", "irradiance_samples"};
  keys.insert(keys.end(), bkm_thesis_keys.begin(), bkm_thesis_keys.end());
  check_keys(node, keys);
  SolverSettings solver;
  if (const auto* key = node.find("tolerance")) {
    solver.tolerance = read_number(*key, between_0_and_1);
  }
  if (const auto* key = node.find("source")) solver.source = read_choice(*key, source_models);
  if (const auto* key = node.find("method")) solver.method = read_choice(*key, methods);
  if (const auto* key = node.find("boundary")) solver.boundary = read_choice(*key, boundaries);
  if (const auto* key = node.find("exitance")) solver.exitance = read_choice(*key, exitances);
  if (const auto* key = node.find("diffusion")) solver.diffusion = read_choice(*key, diffusions);
  solver.photons = default_photons(solver.tolerance);
  solver.photons_at_most = true;
  if (const auto* key = node.find("photons")) {
    solver.photons = read_count(*key, 1, max_photons);
    solver.photons_at_most = false;
  }
  if (const auto* key = node.find("knots")) {
    solver.knots = read_count(*key, min_knots, max_knots);
  }
  solver.thesis = read_bkm_thesis(node);
  if (solver.source == SourceModel::irradiance_thesis &&
      solver.thesis.interior_knots != InteriorLayout::two_layers)
    fail(*node.find("interior_knots"),
         "has no knots one mean free path down, where irradiance_thesis puts its values, expected "
         "two_layers with it");
  if (const auto* key = node.find("estimate_photons")) {
    solver.estimate_photons = read_count(*key, 2, max_estimate_photons);
  }
  if (const auto* key = node.find("divergence")) {
    solver.divergence = read_choice(*key, divergences);
  }
  if (const auto* key = node.find("deposits")) solver.deposits = read_choice(*key, deposit_rules);
  if (const auto* key = node.find("returning_light")) solver.returning_light = read_bool(*key);
  if (const auto* key = node.find("similarity")) solver.similarity = read_bool(*key);
  if (const auto* key = node.find("estimator")) solver.estimator = read_choice(*key, estimators);
  if (const auto* key = node.find("estimate_radius")) {
    solver.estimate_radius = read_number(*key, estimate_radii);
  }
  if (const auto* key = node.find("irradiance_samples")) {
    solver.irradiance_samples = read_count(*key, 2, max_irradiance_samples);
  }
  return solver;
}

}  // namespace knotlight
