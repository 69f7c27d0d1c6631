// One source model run on a scene: what it gives and what it costs.
#pragma once

#include <optional>
#include <string>

#include "core/image_io.h"
#include "pipeline/solve_scene.h"

namespace knotlight {

struct ModelCost {
  double light = 0.0;        // seconds: photons, irradiance samples
  double grid = 0.0;         // seconds: cells
  double solve = 0.0;        // seconds, with the checks
  double picture = 0.0;      // seconds
  double cpu = 0.0;          // CPU seconds of all threads, to the solution
  double picture_cpu = 0.0;  // CPU seconds of the picture alone
  double memory = 0.0;  // MiB at the peak, beyond what was in use before; NaN where the system does
                        // not tell

  double solution() const { return light + grid + solve; }
};

struct ModelRun {
  SourceModel model = SourceModel::photon_map;
  std::string cannot;  // why the model cannot be run on this scene; empty if it was
  std::optional<SolvedScene> solved;
  ModelCost cost;
  std::optional<Image> picture;  // linear radiance, W/(length^2 sr); if asked for

  bool ran() const { return solved.has_value(); }
};

// Solves the scene with `settings`, and puts the scene's own settings
// back. A model that the settings do not allow (InputError) gives a run with `cannot`. seed: of the
// light; the picture is taken with that of `run`, so that the noise of all pictures is alike.
ModelRun run_model(PreparedScene& prepared, const SolverSettings& settings, std::uint64_t seed,
                   bool picture, const RunContext& run);

// U_d on the surface of translucent object number `object` (in SolvedScene::objects) in channel 0;
// positions and outward normals: 3 x N; N values, W/(length^2 sr).
Eigen::VectorXd surface_U_d(const ModelRun& run, const PreparedScene& prepared, std::size_t object,
                            const Points& positions, const Points& normals, std::uint64_t seed,
                            const Workers& workers);

// U_d inside the object in channel 0. U_ri at the points is what boundary_flux, which solves for
// both together, is freed from.
Eigen::VectorXd inner_U_d(const ModelRun& run, std::size_t object, const Points& positions,
                          const Eigen::VectorXd& U_ri, const Workers& workers);

}  // namespace knotlight
