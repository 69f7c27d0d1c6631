#include "validate/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "grid/cell_size.h"

namespace knotlight {

Scene scene_of(Shape shape, const Medium& medium, std::vector<Light> lights) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(medium.sigma_a);
  material.sigma_s = Spectrum::Constant(medium.sigma_s);
  material.g = Spectrum::Constant(medium.g);
  material.ior = medium.ior;
  material.emission = Spectrum::Constant(medium.emission);
  Scene scene;
  scene.objects = {{"body", std::move(shape), material}};
  scene.lights = std::move(lights);
  return scene;
}

// The cell size goes with the square root of the tolerance (grid/cell_size.h): the tolerance that
// gives the cells wanted.
SolvedScene solve_case(Scene scene, const CaseSolver& solver, const CaseRun& run) {
  const Medium medium = scene.objects[0].translucent()->medium(0);
  constexpr double usual_tolerance = 0.01;
  const double usual_cell =
      cell_size_for(scene.objects[0].shape, medium.sigma_tr(), medium.sigma_t(), usual_tolerance,
                    std::numeric_limits<std::size_t>::max())
          .h_sigma_tr;
  if (!scene.solver.source) scene.solver.source = SourceModel::photon_map;
  scene.solver.method = Method::grid;
  scene.solver.boundary = solver.boundary;
  scene.solver.photons = solver.photons;
  scene.solver.tolerance = usual_tolerance * std::pow(solver.cell / usual_cell, 2);
  RunOptions options;
  options.seed = run.seed;
  options.threads = 1;
  options.quiet = true;
  RunContext context(options, false);
  return solve_scene(prepare_scene(std::move(scene)), context);
}

ValidationRow relative_row(const std::string& quantity, double value, double reference,
                           double allowed, const std::string& why) {
  return {quantity, value, reference, std::abs(value / reference - 1.0), allowed, why};
}

ValidationRow l2_row(const std::string& quantity, const Eigen::VectorXd& value,
                     const Eigen::VectorXd& reference, double allowed, const std::string& why) {
  const double n = std::sqrt(static_cast<double>(value.size()));
  return {quantity,
          value.norm() / n,
          reference.norm() / n,
          (value - reference).norm() / reference.norm(),
          allowed,
          why};
}

ValidationRow energy_balance(const ChannelReport& report, double allowed) {
  const double sampling = standard_errors_allowed * report.energy_imbalance_standard_error;
  return {"(leaving + absorbed - in) / in",
          report.energy_imbalance,
          0.0,
          std::abs(report.energy_imbalance),
          allowed + sampling,
          fmt::format("{:.2g} % of the solve + {} standard errors of the absorption, sampled",
                      100.0 * allowed, standard_errors_allowed)};
}

std::string grid_reason(const CaseSolver& solver) {
  return fmt::format("grid of {:.2g} transport mean free paths, {:.2g} M rays", solver.cell,
                     1e-6 * static_cast<double>(solver.photons));
}

}  // namespace knotlight
