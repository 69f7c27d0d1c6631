// What every method is given for one object in one channel, and what it gives back.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/medium.h"
#include "core/parallel.h"
#include "grid/solver.h"
#include "pipeline/factor_cache.h"
#include "pipeline/incident_light.h"
#include "pipeline/sample_points.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct ObjectGrids;  // solve_grid.h

struct ChannelProblem {
  const Scene& scene;
  const Shape& shape;
  int channel;
  const Medium& medium;
  const DiffusionCoefficients& coefficients;
  const SolverSettings& settings;
  const IncidentLight& light;
  const ObjectGrids* grids;  // shared by the object's channels; null unless the method is grid
  const RayCaster& caster;
  std::uint32_t object;  // index in the caster
  std::uint64_t seed;
  const Workers& workers;
  FactorCache& factors;

  FactorCache::Key factor_key(Method method) const {
    return {object, method, coefficients.lambda, coefficients.k};
  }
};

// U_d at points in or on the object (3 x N), N values, W/(length^2 sr).
using FieldValues = std::function<Eigen::VectorXd(const Points&)>;

struct ChannelSolution {
  Method method = Method::grid;  // that found it
  // The same as U_d, of a method that has it on a grid.
  std::optional<GridField> on_grid;
  FieldValues U_d;      // with the model boundary_flux: U_ri + U_d, which it does not tell apart
  bool solved = false;  // false: U_d is not to be used, failures say why
  double numerical_error = 0.0;  // of solving the equations given the photons, relative
  double noise = 0.0;            // of the photons, relative
  // Figures of this method by name, for the summary (docs/json.md).
  std::vector<std::pair<std::string, double>> figures;
  std::vector<std::string> failures;  // what this method could not do, one sentence each
};

// Points at which solutions are compared: boundary_checks strata of the surface, random in each.
SurfaceSamples boundary_check_points(const ChannelProblem& problem);

double root_mean_square(const Eigen::VectorXd& v);

// 0/0 = 0: an object that no light reaches is dark, and that is exact.
inline double relative(double part, double whole) {
  return part == 0.0 ? 0.0 : part / whole;
}

}  // namespace knotlight
