// Mean intensity U and net flux F in the cells of a grid, from the paths of photons, without a
// diffusion equation: the truth that a solution is measured against (docs/theory.md, section 5b).
#pragma once

#include <vector>

#include "core/medium.h"
#include "core/shape.h"
#include "photon/flux_grid.h"
#include "photon/free_flight.h"

namespace knotlight {

// Light that was not scattered since it entered the object (U_ri), light that was (U_d), or both.
// Light that left the object and came back is unscattered again.
enum class FluxOrder { unscattered, scattered, all };

// Per photon of power P that flies along w, with V the volume of the cell inside the object [LK91]:
//   collisions      U += P / (4 pi sigma_t V),    F += P w / (sigma_t V)      where it interacts,
//   track_lengths   U += P s / (4 pi V),          F += P w s / V              for s in the cell.
enum class FluxEstimator { collisions, track_lengths };

// Means over the inside part of a cell with standard errors (from batches of photons; infinite for
// fewer than two). Not a number where no part of the cell is inside.
struct Flux {
  double U = 0.0;  // W/(length^2 sr)
  double U_error = 0.0;
  Vec3 F = Vec3::Zero();  // W/length^2
  Vec3 F_error = Vec3::Zero();
};

// What the photons of one batch leave in the cells.
class FluxSums {
 public:
  FluxSums(const FluxGrid& grid, std::uint32_t object);
  void add(const FreeFlight& flight);

 private:
  friend class FluxTally;
  // Column = cell; rows = 8 for light of order 0, 8 for the rest, each 4 for collisions (power,
  // power times direction), 4 for track lengths.
  Eigen::ArrayXXd sums_;
  FluxGrid grid_;
  std::uint32_t object_;
};

class FluxTally {
 public:
  // For scene object `object` of that shape and medium. Collisions tell nothing of a medium with
  // sigma_t = 0: 0/0, not a number.
  FluxTally(const FluxGrid& grid, std::uint32_t object, const Shape& shape, const Medium& medium);

  const FluxGrid& grid() const { return grid_; }
  double volume(std::size_t cell) const { return volumes_[cell]; }  // inside part, length^3
  Flux flux(std::size_t cell, FluxOrder order, FluxEstimator estimator) const;

  // For the tracer: batches of equally many photons, added in their order.
  FluxSums batch() const { return FluxSums(grid_, object_); }
  void add(const FluxSums& batch);

 private:
  FluxGrid grid_;
  std::uint32_t object_;
  double sigma_t_;
  std::vector<double> volumes_;
  double batches_ = 0.0;
  // Column = cell; rows = those of FluxSums, then 8 for light of all orders.
  Eigen::ArrayXXd sums_, squares_;
};

}  // namespace knotlight
