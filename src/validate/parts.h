// What the kinds of case share: scenes in memory and rows of the table.
#pragma once

#include <string>

#include "pipeline/solve_scene.h"
#include "validate/cases.h"

namespace knotlight {

// Two-sided, a normal variate is further from its mean with probability 1e-6: what separates a
// wrong figure from a noisy one.
constexpr double standard_errors_allowed = 4.892;

// An object named "body" of one channel, shape and medium given, at default settings otherwise.
Scene scene_of(Shape shape, const Medium& medium, std::vector<Light> lights);

// A scene solved as a case wants it: method grid, and the photon map unless the scene says
// otherwise.
SolvedScene solve_case(Scene scene, const CaseSolver& solver, const CaseRun& run);

// Relative to the reference.
ValidationRow relative_row(const std::string& quantity, double value, double reference,
                           double allowed, const std::string& why);
// Root of the sum of squares of the difference over that of the reference; the row's value and
// reference are the two root mean squares.
ValidationRow l2_row(const std::string& quantity, const Eigen::VectorXd& value,
                     const Eigen::VectorXd& reference, double allowed, const std::string& why);

// (leaving + absorbed - in) / in as the program reports it, against 0.
ValidationRow energy_balance(const ChannelReport& report, double allowed);

// Why a grid solution may be off by `solver.allowed`.
std::string grid_reason(const CaseSolver& solver);

}  // namespace knotlight
