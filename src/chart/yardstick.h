// What settings are measured against on one scene: converged fields, path tracing.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "chart/picture_blocks.h"
#include "compare/measure.h"
#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"

namespace knotlight {

// What a model of light gives with its numerical error and noise all but gone.
struct Converged {
  Eigen::VectorXd field;    // U_d at the checks; empty beyond P1, which solves for a part of it
  Eigen::VectorXd picture;  // block means
  std::string doubt;        // why it is not to be trusted; empty: it is
};

struct Yardstick {
  SurfaceChecks checks;
  PictureBlocks blocks;
  PictureBlocks::Judged truth;              // path tracing
  double truth_noise = 0.0;                 // relative root mean square, of its blocks
  double truth_seconds = 0.0;               // CPU
  std::map<std::string, Converged> models;  // by model_of

  // The field that all others are measured against: P1, light by the photon map.
  const Eigen::VectorXd& field() const;
};

// Where fields are compared and what by.field() is there, for other programs: x, y, z, the area
// each point stands for, U_d (nan: the converged run failed).
std::string points_csv(const Yardstick& by);

// Source, exitance and diffusion of the settings as pictures take them: what remains when
// everything has converged. Empty for irradiance_thesis, which converges to nothing.
std::string model_of(SolverSettings settings);

// How fine the converged runs are, beside the finest settings that are charted.
struct ConvergedSettings {
  double tolerance;
  std::size_t photons;
  std::size_t irradiance_samples;
};

// Traces the picture until its blocks have this relative noise, and solves every model of
// `settings`. All is kept in `folder` as it is found, and taken from there the next time; files
// there that belong to another scene or seed throw InputError.
Yardstick make_yardstick(PreparedScene& prepared, const std::vector<SolverSettings>& settings,
                         const ConvergedSettings& converged, double noise,
                         const std::string& folder, RunContext& run);

}  // namespace knotlight
