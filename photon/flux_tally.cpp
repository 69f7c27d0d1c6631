#include "photon/flux_tally.h"

#include <limits>
#include <numbers>

#include "photon/cell_volume.h"

namespace knotlight {
namespace {

constexpr int estimator_rows = 4;  // power and its three components along the direction
constexpr int order_rows = 2 * estimator_rows;
constexpr int batch_rows = 2 * order_rows;
constexpr int tally_rows = 3 * order_rows;

int first_row(FluxOrder order, FluxEstimator estimator) {
  return order_rows * static_cast<int>(order) + estimator_rows * static_cast<int>(estimator);
}

}  // namespace

FluxSums::FluxSums(const FluxGrid& grid, std::uint32_t object)
    : sums_(Eigen::ArrayXXd::Zero(batch_rows, static_cast<Eigen::Index>(grid.cells()))),
      grid_(grid),
      object_(object) {}

void FluxSums::add(const FreeFlight& flight) {
  if (flight.object != object_) return;
  const FluxOrder order = flight.order == 0 ? FluxOrder::unscattered : FluxOrder::scattered;
  const auto add_to = [&](std::size_t cell, FluxEstimator estimator, double amount) {
    auto rows = sums_.block<estimator_rows, 1>(first_row(order, estimator),
                                               static_cast<Eigen::Index>(cell));
    rows[0] += amount;
    rows.tail<3>() += amount * flight.direction.array();
  };
  grid_.along(flight.start, flight.direction, flight.length, [&](std::size_t cell, double length) {
    add_to(cell, FluxEstimator::track_lengths, flight.power * length);
  });
  if (!flight.interacts) return;
  if (const auto cell = grid_.cell_at(flight.start + flight.length * flight.direction))
    add_to(*cell, FluxEstimator::collisions, flight.power);
}

FluxTally::FluxTally(const FluxGrid& grid, std::uint32_t object, const Shape& shape,
                     const Medium& medium)
    : grid_(grid),
      object_(object),
      sigma_t_(medium.sigma_t()),
      volumes_(volumes_inside(shape, grid)),
      sums_(Eigen::ArrayXXd::Zero(tally_rows, static_cast<Eigen::Index>(grid.cells()))),
      squares_(sums_) {}

void FluxTally::add(const FluxSums& batch) {
  const Eigen::ArrayXXd all =
      batch.sums_.topRows<order_rows>() + batch.sums_.bottomRows<order_rows>();
  sums_.topRows<batch_rows>() += batch.sums_;
  sums_.bottomRows<order_rows>() += all;
  squares_.topRows<batch_rows>() += batch.sums_.square();
  squares_.bottomRows<order_rows>() += all.square();
  batches_ += 1.0;
}

Flux FluxTally::flux(std::size_t cell, FluxOrder order, FluxEstimator estimator) const {
  const auto c = static_cast<Eigen::Index>(cell);
  const int row = first_row(order, estimator);
  const Eigen::Array4d sum = sums_.block<estimator_rows, 1>(row, c);
  Eigen::Array4d error = Eigen::Array4d::Constant(std::numeric_limits<double>::infinity());
  if (batches_ > 1.5) {
    const Eigen::Array4d squares = squares_.block<estimator_rows, 1>(row, c);
    // Rounding may leave less than nothing where every batch gave the same.
    error = ((squares - sum.square() / batches_).max(0.0) * (batches_ / (batches_ - 1.0))).sqrt();
  }
  const double seen = volumes_[cell] * (estimator == FluxEstimator::collisions ? sigma_t_ : 1.0);
  Flux flux;
  flux.U = sum[0] / (4.0 * std::numbers::pi * seen);
  flux.U_error = error[0] / (4.0 * std::numbers::pi * seen);
  flux.F = sum.tail<3>() / seen;
  flux.F_error = error.tail<3>() / seen;
  return flux;
}

}  // namespace knotlight
