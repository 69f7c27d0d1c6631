// The figures of a comparison: everything its page, its tables and its verdict are made from.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/models.h"
#include "compare/places.h"
#include "compare/truth.h"
#include "report/false_colour.h"

namespace knotlight {

// Relative errors, NaN where there is nothing to compare. All but `picture` are of U_d in channel
// 0.
struct ModelErrors {
  double surface = 0.0;    // rms over the surface of all objects, against the converged solution
  double picture = 0.0;    // rms of luminance where objects are seen, against the converged picture
  double diffusion = 0.0;  // rms inside the object, against the converged solution
  double transport = 0.0;  // rms inside the object, against photons of all orders; their noise is
                           // taken off
  double noise = 0.0;      // of the light, by the solver's own estimate
  double numerical = 0.0;  // of the solve, by the solver's own estimate
  double energy = 0.0;     // imbalance
};

// One point of the chart of error against time; channel 0 alone.
struct BudgetPoint {
  double budget = 0.0;   // photons, irradiance samples or knots
  double seconds = 0.0;  // light, grid and solve
  double error = 0.0;    // on the surface, as ModelErrors::surface
};

struct ComparedModel {
  ModelRun run;
  ModelErrors errors;
  std::vector<Eigen::VectorXd> lines;  // U_d at LineCells, one per line
  ValueMap surface;                    // difference of U_d to the converged, of its rms, per pixel
  ValueMap picture;                    // difference of luminance, of its rms, per pixel
  ValueMap slice;                      // source density
  std::vector<BudgetPoint> budgets;
};

struct Comparison {
  std::string scene_path, units, object;  // object: that lines, slices and truth are of
  double tolerance = 0.0;
  std::size_t photons = 0;  // rays of photon_map, per channel
  double sigma_tr = 0.0;    // of the object in channel 0, 1/length
  std::string no_truth;     // why there is no transport truth; empty if there is
  TransportTruth truth;
  ModelErrors diffusion_itself;  // of the converged solution: `transport` is what P1 misses
  ModelRun converged;
  double converged_error = 0.0;  // its own estimate
  ValueMap converged_surface;    // U_d per pixel
  std::array<InwardLine, 3> lines;
  std::array<std::vector<LineCell>, 3> line_cells;
  std::vector<Eigen::VectorXd> converged_lines;
  Slice slice;
  std::vector<ComparedModel> models;
};

// Root mean square of a - b over that of b, weights optional (empty = equal). NaN if b is all zero
// but a is not.
double relative_rms(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                    const Eigen::VectorXd& weights = {});

// The same where b is known up to independent errors of standard deviation b_error: the part of the
// difference that these explain is taken off (0 if they explain it all).
double relative_rms_beyond_noise(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                 const Eigen::VectorXd& b_error);

// Rec. 709 luminance.
double luminance(const Spectrum& c);

}  // namespace knotlight
