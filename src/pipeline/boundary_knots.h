// What every boundary method asks of an object: points on its surface, what is inside, and the
// Robin data that the particular solution leaves.
#pragma once

#include <array>
#include <vector>

#include "bkm/patch_tree.h"
#include "pipeline/channel_problem.h"
#include "pipeline/particular_solution.h"

namespace knotlight {

// `count` or a few more points of the surface, one in each stratum of equal area, in an order in
// which every long enough prefix is evenly spread too (van der Corput's over the strata).
SpreadKnots spread_surface_knots(const Shape& shape, std::size_t count, std::uint64_t seed);

// The object's geometry as the questions of the local method.
BodyQueries body_queries(const ChannelProblem& problem);

// The right-hand side g of u + k du/dn = g that the particular solution leaves to the homogeneous
// one, for each half of the light. particular: its values there, with normal derivatives.
struct BoundaryData {
  std::array<Eigen::VectorXd, 2> g;
};
BoundaryData boundary_data(const ChannelProblem& problem, const ParticularValues& particular,
                           const SurfaceSamples& at, std::uint64_t seed);

}  // namespace knotlight
