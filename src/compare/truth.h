// The truth that source models are measured against: photons of all orders, counted in cells, with
// no diffusion equation anywhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/places.h"

namespace knotlight {

// Cells that lie wholly inside the object; per cell U_d, its standard error, and U_ri; channel 0,
// W/(length^2 sr).
struct TransportTruth {
  Points centers;  // 3 x N
  Eigen::VectorXd U_d, U_d_error, U_ri;
  double cell = 0.0;        // edge, length
  std::size_t photons = 0;  // emitted
  double seconds = 0.0;
};

// Why photons cannot tell the truth for the scene; empty if they can.
std::string no_truth_because(const PreparedScene& prepared);

// `object`: index in the scene. Follows as many photons as interact about `interactions` times in
// all. Where photons cannot tell the truth (no_truth_because), the cells are there all the same,
// their values not-a-number. Same bits for any number of workers.
TransportTruth trace_truth(const PreparedScene& prepared, std::uint32_t object, double interactions,
                           std::uint64_t seed, RunContext& run);

// Cells along a line: those whose centre lies within 0.75 cells of it. `cell`: column of the
// truth; increasing depth.
struct LineCell {
  std::size_t cell;
  double depth;  // of the centre below the start, length
};
std::vector<LineCell> cells_along(const InwardLine& line, const TransportTruth& truth);

}  // namespace knotlight
