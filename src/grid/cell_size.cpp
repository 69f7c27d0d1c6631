#include "grid/cell_size.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

// At these the relative error is 0.01 or less in the measured cases (docs/grid.md).
constexpr double usual_tolerance = 0.01;
constexpr double transport_mean_free_paths_per_cell = 0.5;
constexpr double mean_free_paths_per_cell = 0.75;
constexpr double cells_per_size = 64.0;
// A cell of the bounding box costs an eighth of one inside or less: 4 bytes, and no work per step.
constexpr double box_share = 8.0;

constexpr double usual_budget = 2e6;
constexpr double largest_budget = 8e6;

}  // namespace

std::size_t cell_budget(double tolerance) {
  return static_cast<std::size_t>(
      std::clamp(usual_budget * usual_tolerance / tolerance, usual_budget, largest_budget));
}

CellSize cell_size_for(const Shape& shape, double sigma_tr, double sigma_t, double tolerance,
                       std::size_t most_cells) {
  const Bounds box = bounds(shape);
  const double rule = std::min(
      coarsest_cells / sigma_tr,
      std::sqrt(tolerance / usual_tolerance) *
          std::min({transport_mean_free_paths_per_cell / sigma_tr,
                    mean_free_paths_per_cell / sigma_t, box.largest_extent() / cells_per_size}));
  const auto most = static_cast<double>(most_cells);
  const double budget = std::max(std::cbrt(volume(shape) / most),
                                 std::cbrt((box.hi - box.lo).prod() / (box_share * most)));
  const double h = std::max(rule, budget);
  return {h, h * sigma_tr, rule};
}

}  // namespace knotlight
