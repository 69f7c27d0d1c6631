// An error taken apart: what seeds make of it, what coarseness, and what the model itself.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "chart/measurement.h"

namespace knotlight {

// Root mean square of a - b relative to b.
using RelativeRms = std::function<double(const Eigen::VectorXd& a, const Eigen::VectorXd& b)>;

// values: one setting's, of each of its seeds. truth_noise: relative, of `truth`. converged: of the
// same model; empty: unknown. An error that the truth's noise could hide is said as large as it
// could be.
ErrorParts error_parts(const std::vector<Eigen::VectorXd>& values, const Eigen::VectorXd& truth,
                       double truth_noise, const Eigen::VectorXd& converged,
                       const RelativeRms& error);

}  // namespace knotlight
